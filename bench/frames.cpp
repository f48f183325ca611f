// SPDX-License-Identifier: MIT
//
// Whole frames, from and to the pose buffers of 8,192 characters with 16,384 arms, on one thread. swivel runs in one
// call, with each instruction set. With the best one, its three steps also run apart. The rivals solve one arm at a
// time: a textbook with glm, and ozz-animation where it was built in.
#include "bench/rivals/level.h"
#include "bench/rivals/ozz_frame.h"
#include "bench/rivals/whole_frame.h"
#include "bench/suite.h"

namespace bench {

namespace {

constexpr std::size_t kCharacters = 8192;

Notes checked(const std::string& name, WholeFrame& frame, const Work& solve)
{
    frame.spoil();
    solve();
    return bench::checked(name, frame.worst_error());
}

}  // namespace

void add_frames(Suite& suite)
{
    const auto frame = std::make_shared<WholeFrame>(kCharacters);
    const auto timed = [&](const std::string& name, const std::string& isa, const Work& work, Notes notes = {}) {
        const auto prepare = [isa, work] {
            swivel::check(swivel_use_isa(isa.c_str()));
            return work;
        };
        add(name, frame->arm_count(), Clock::cpu, prepare, std::move(notes));
    };
    const Work in_one = [frame] { frame->framed().solve_in_one(); };
    const Work apart = [frame] { frame->framed().write(), frame->framed().solve(), frame->framed().read(); };
    for (const std::string& isa : suite.isas) {
        swivel::check(swivel_use_isa(isa.c_str()));
        timed("frame/" + isa + "/in_one", isa, in_one, checked("frame/" + isa, *frame, in_one));
    }
    const std::string best = suite.best_isa();
    swivel::check(swivel_use_isa(best.c_str()));
    timed("frame/" + best + "/apart", best, apart, checked("frame/" + best + "/apart", *frame, apart));
    timed("frame/" + best + "/write", best, [frame] { frame->framed().write(); });
    timed("frame/" + best + "/solve", best, [frame] { frame->framed().solve(); });
    timed("frame/" + best + "/read", best, [frame] { frame->framed().read(); });
    const auto ozz = std::make_shared<OzzFrame>(frame->view());
    for (const Level* level : runnable_levels()) {
        const std::string name = std::string("/") + level->name;
        const Work glm = [frame, level] { level->solve_frame(frame->view()); };
        timed("frame_glm" + name, best, glm, checked("frame_glm" + name, *frame, glm));
        if (!level->solve_frame_ozz) continue;
        const Work by_ozz = [frame, ozz, level] { level->solve_frame_ozz(frame->view(), ozz->view()); };
        timed("frame_ozz" + name, best, by_ozz, checked("frame_ozz" + name, *frame, by_ozz));
    }
}

}  // namespace bench
