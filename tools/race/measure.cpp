// SPDX-License-Identifier: MIT
//
// Problem P: targets, poles and bone lengths in; shoulder rotations, half flexions and flags out, arms in their own
// frame. Resident: world targets and parent frames in, local rotations out. Whole frame: the same from and to the pose
// buffers of 16,384 arms.
#include "tools/race/measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/rivals/check.h"
#include "bench/rivals/contenders.h"
#include "bench/rivals/probe.h"
#include "bench/rivals/whole_frame.h"
#include "tools/cli/command_error.h"
#include "tools/crowd/parallel.h"
#include "tools/race/race.h"

namespace swivel::tools {

namespace {

constexpr std::size_t kFrameCharacters = 8192;
constexpr std::size_t kSizes[] = {64, 256, 1024, 4096, 16384, 65536, 262144, 1048576};
constexpr std::size_t kThreadArms = 262144;  // 16 MB of rows: many chunks for each thread

void require_right(const std::string& name, double worst)
{
    if (!(worst < bench::kRightWithin))
        throw CommandError(1, fmt::format("{} is off by {:.1e} of the arm's length; nothing was timed", name, worst));
}

// The runners, by name; what they work on lives as long as this.
class Bench {
public:
    Bench(std::string isa, bool with_sizes)
        : isa_(std::move(isa)),
          limbs_(bench::random_limbs(bench::arms_within(1, 0))),
          cached_(bench::make_crowd(0, limbs_.size(), limbs_)),
          large_(bench::make_crowd(0, bench::arms_within(3, 0), limbs_)),
          resident_(bench::make_crowd(bench::kResident, bench::arms_within(1, bench::kResident), limbs_)),
          shared_(bench::make_crowd(0, kThreadArms, limbs_)),
          frame_(kFrameCharacters)
    {
        add_cached();
        add_rivals();
        add_frames();
        if (with_sizes) add_sizes();
        add_crowd("resident", resident_, isa_);
        add_crowd("memory", large_, isa_);
        const swivel_rows in = swivel_input_rows(large_.get(), 0), out = swivel_result_rows(large_.get(), 0);
        const bench::Probe& widest = bench::probe_of(bench::runnable_isas().front().c_str());
        race_.add("copy", limb_count(large_), [=, copy = widest.copy_rows] {
            copy(in.base, in.row_count, out.base, out.row_count, in.block_count);
        });
        if (thread_count() > 1) {
            add_threads("one thread", 1);
            add_threads("all threads", 0);
        }
    }

    void run(double seconds, bool quiet) { race_.run(seconds, quiet); }

    std::vector<Pair> pairs() const
    {
        std::vector<Pair> pairs;
        const auto pair = [&](std::string work, const std::string& isa, std::string own, std::string other,
                              std::string note) {
            const double own_ns = race_.ns(own), other_ns = race_.ns(other);
            pairs.push_back(
                {std::move(work), isa, std::move(own), std::move(other), std::move(note), own_ns, other_ns});
        };
        for (const std::string& isa : bench::runnable_isas()) {
            const bench::Level* level = bench::level_for(isa);
            for (const bench::Contender& rival : rivals_)
                if (level && rival.level == level->name && (level->isa == isa || rival.name == "single_glm"))
                    pair("P in cache", isa, "P " + isa, rival.name + " " + rival.level, rival.how);
        }
        pair("P out of cache", isa_, "memory", "copy", "of the same rows, nothing solved");
        if (thread_count() > 1)
            pair(fmt::format("P, {} threads", thread_count()), isa_, "all threads", "one thread", "swivel");
        if (const bench::Level* level = bench::level_for(isa_)) {
            const std::string glm = fmt::format("frame_glm {}", level->name);
            pair("resident", isa_, "resident", glm, "the whole frame, one arm at a time");
            pair("whole frame", isa_, "frame in one", glm, "one arm at a time");
        }
        pair("whole frame", isa_, "frame in one", "frame in steps", "swivel: write, solve, read");
        return pairs;
    }

    std::vector<Size> sizes() const
    {
        std::vector<Size> sizes;
        if (sized_.empty()) return sizes;
        for (const std::size_t arms : kSizes)
            sizes.push_back(
                {arms, race_.ns(fmt::format("P of {}", arms)), race_.ns(fmt::format("resident of {}", arms))});
        return sizes;
    }

    double ns(const std::string& name) const { return race_.ns(name); }

private:
    static std::size_t limb_count(const Crowd& crowd) { return swivel_group_limb_count(crowd.get(), 0); }

    void add_crowd(const std::string& name, Crowd& crowd, const std::string& isa)
    {
        race_.add(name, limb_count(crowd), [&crowd, isa] { bench::solve_all(crowd, isa); });
    }
    void add_sizes()
    {
        for (const std::size_t arms : kSizes) {
            sized_.push_back(bench::make_crowd(0, arms, limbs_));
            sized_.push_back(bench::make_crowd(bench::kResident, arms, limbs_));
        }
        for (std::size_t n = 0; n < std::size(kSizes); ++n) {
            add_crowd(fmt::format("P of {}", kSizes[n]), sized_[2 * n], isa_);
            add_crowd(fmt::format("resident of {}", kSizes[n]), sized_[2 * n + 1], isa_);
        }
    }
    void add_threads(const std::string& name, unsigned most)
    {
        race_.add(name, kThreadArms, [this, most] {
            const ThreadLimit limit(most);
            check(swivel_use_isa(isa_.c_str()));
            shared_.solve({.on_this_thread = is_one_thread()});
        });
    }
    void add_cached()
    {
        for (const std::string& isa : bench::runnable_isas()) {
            bench::solve_all(cached_, isa);
            require_right("swivel on " + isa, bench::worst_error(limbs_, bench::poses_of(cached_)));
            add_crowd("P " + isa, cached_, isa);
        }
    }
    void add_frame(const std::string& name, const std::function<void()>& work)
    {
        check(swivel_use_isa(isa_.c_str()));
        frame_.spoil();
        work();
        require_right(name, frame_.worst_error());
        race_.add(name, frame_.arm_count(), [this, work] {
            check(swivel_use_isa(isa_.c_str()));
            work();
        });
    }
    void add_frames()
    {
        add_frame("frame in one", [this] { frame_.solve_in_one(); });
        add_frame("frame in steps", [this] { frame_.write(), frame_.solve(), frame_.read(); });
        if (const bench::Level* level = bench::level_for(isa_))
            add_frame(fmt::format("frame_glm {}", level->name), [this, level] { level->solve_frame(frame_.view()); });
    }
    void add_rivals()
    {
        for (const bench::Level* level : bench::runnable_levels())
            for (bench::Contender& rival : bench::contenders(*level, limbs_)) {
                rival.solve();
                require_right(rival.name, bench::worst_error(limbs_, rival.poses()));
                race_.add(rival.name + " " + rival.level, limbs_.size(), rival.solve);
                rivals_.push_back(std::move(rival));
            }
    }

    std::string isa_;
    std::vector<bench::Limb> limbs_;
    Crowd cached_, large_, resident_, shared_;
    std::vector<Crowd> sized_;  // for each of kSizes: plain, resident; or none
    bench::WholeFrame frame_;
    std::vector<bench::Contender> rivals_;
    Race race_;
};

// Leaves the process with the instruction set it had.
struct KeepIsa {
    std::string isa;
    ~KeepIsa() { swivel_use_isa(isa.c_str()); }
};

}  // namespace

Measured measure(double seconds, bool with_sizes, bool quiet)
{
    const char* isa = swivel_isa_name();
    if (!isa) throw CommandError(1, swivel_last_error());
    const KeepIsa keep{isa};
    Bench runners(keep.isa, with_sizes);
    Measured out{bench::measure_machine(), bench::count_ops(), bench::row_bytes(0), 0, keep.isa, {}, {}, {}};
    runners.run(seconds, quiet);
    out.memory_ns = runners.ns("memory");
    out.pairs = runners.pairs();
    out.sizes = runners.sizes();
    for (const bench::IsaLimits& limits : out.machine.isas)
        out.bounds.push_back({limits.isa, bench::port_bound(out.ops, limits), runners.ns("P " + limits.isa)});
    return out;
}

}  // namespace swivel::tools
