// SPDX-License-Identifier: MIT
#include "tools/cache/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <semaphore>

#include "tools/cache/column.h"
#include "tools/crowd/parallel.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace swivel::tools {

namespace {

#ifdef SWIVEL_WITH_TBB

constexpr int kWaiting = 2;  // threads beside the solver's, which wait for the disk

unsigned solver_count(const FillOptions& options)
{
    return options.threads > 0 ? options.threads : static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
}

// Gives back its place among those that solve, however the solving ends.
struct Release {
    std::counting_semaphore<>& solvers;
    ~Release() { solvers.release(); }
};

#else

unsigned solver_count(const FillOptions&) { return 1; }

#endif

using Characters = std::shared_ptr<const std::vector<goal_character>>;

// A chunk on its way.
struct Work {
    ChunkAt at;
    Characters characters;  // of its column
    ChunkGoals goals;
    std::optional<Results> state;  // to start from; none: from the frame before, or from nothing
    Results results;
    std::uint64_t stored = 0, digest = 0;
};

class Filling {
public:
    Filling(const Cache& cache, const FillOptions& options)
        : cache_(cache),
          options_(options),
          threads_(solver_count(options)),
          chunks_(chunks_of(cache.crowd(), options.shard))
    {
    }

    FillReport run()
    {
        const auto begin = std::chrono::steady_clock::now();
        threads_ == 1 ? run_in_turn() : run_at_once();
        report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        std::ranges::sort(report_.differences, {},
                          [](const Difference& d) { return std::pair(d.at.column, d.at.time); });
        return std::move(report_);
    }

private:
    // Null: there is no more. The chunk lives until write() has stored it.
    Work* read_next()
    {
        for (; next_ < chunks_.size(); ++next_) {
            const ChunkAt at = chunks_[next_];
            const std::uint64_t stored = cache_.digest(at);
            if (stored != 0 && !options_.proves) {
                const std::lock_guard lock(mutex_);
                ++report_.left;
                note_through();
                continue;
            }
            auto work =
                std::make_unique<Work>(Work{at, {}, cache_.goals(at), {}, empty_results(cache_.crowd()), stored, 0});
            if (!read_last_ || read_last_->column != at.column)
                characters_ = std::make_shared<const std::vector<goal_character>>(cache_.characters(at.column));
            work->characters = characters_;
            const bool follows = read_last_ && *read_last_ == ChunkAt{at.time - 1, at.column};
            if (cache_.crowd().carries_state() && at.time > 0 && !follows)
                work->state = cache_.require_state({at.time - 1, at.column});
            read_last_ = at;
            ++next_;
            const std::lock_guard lock(mutex_);
            return under_way_.emplace_back(std::move(work)).get();
        }
        return nullptr;
    }

    // The chunk's column, as it was left; a new one if there is none. There are never more of them than threads.
    std::unique_ptr<Column> take_column(const Work& work)
    {
        std::unique_ptr<Column> column;
        {
            const std::lock_guard lock(mutex_);
            auto found = std::ranges::find(columns_, work.at.column, [](const auto& each) { return each->index(); });
            if (found == columns_.end() && !columns_.empty()) --found;  // one goes, to make room for a new one
            if (found != columns_.end()) {
                column = std::move(*found);
                columns_.erase(found);
            }
        }
        if (column && column->index() == work.at.column) return column;
        column.reset();  // before the new one takes memory
        return std::make_unique<Column>(cache_.crowd(), work.at.column, *work.characters);
    }

    void solve(Work& work)
    {
        std::unique_ptr<Column> column = take_column(work);
        if (work.state) column->restore(*work.state);
        work.digest = column->solve(work.at.time, work.goals, work.results);
        const std::lock_guard lock(mutex_);
        columns_.push_back(std::move(column));
    }

    // Between what a chunk has and what its goals give.
    std::optional<Difference> difference(const Work& work) const
    {
        const CachedCrowd& crowd = cache_.crowd();
        const auto compare = [](const std::optional<Results>& stored, const Results& wanted,
                                const std::vector<ZarrArray>& arrays, const char* of_what) -> std::string {
            if (!stored) return fmt::format("a file of its {} is missing or damaged", of_what);
            for (std::size_t n = 0; n < wanted.size(); ++n)
                if (!(*stored)[n].empty() && (*stored)[n] != wanted[n])
                    return fmt::format("{} differs", arrays[n].name);
            return "";
        };
        if (work.stored == 0) return Difference{work.at, "is not done", true};
        std::string what =
            crowd.has_poses ? compare(cache_.results(work.at), work.results, cache_.arrays().results, "poses") : "";
        if (work.stored != work.digest) {
            const bool is_mended = crowd.has_poses && what.empty();
            return Difference{work.at, what.empty() ? "digest differs" : "digest differs, and " + what, is_mended};
        }
        if (what.empty() && crowd.carries_state())
            what = compare(cache_.state(work.at), last_frame(work.results, crowd, work.at.time), cache_.arrays().state,
                           "state");
        if (what.empty()) return std::nullopt;
        return Difference{work.at, what, true};
    }

    // With the lock.
    void note_through()
    {
        ++through_;
        if (options_.progress) options_.progress(through_);
    }

    void write(Work& work)
    {
        const std::optional<Difference> found = difference(work);
        const bool is_written = found && found->is_mended;
        if (is_written) cache_.write(work.at, work.results, work.digest);
        const CachedCrowd& crowd = cache_.crowd();
        std::unique_ptr<Work> done;  // is freed after the lock
        const std::lock_guard lock(mutex_);
        const auto at = std::ranges::find(under_way_, &work, [](const auto& each) { return each.get(); });
        done = std::move(*at);
        under_way_.erase(at);
        if (found && options_.proves) report_.differences.push_back(*found);
        ++(is_written ? report_.written : report_.left);
        report_.limbs +=
            std::uint64_t{crowd.frames_in(work.at.time)} * crowd.characters_in(work.at.column) * crowd.limbs.size();
        note_through();
    }

    // Reads, solves and writes one chunk after the other, all on this thread.
    void run_in_turn()
    {
        const ThreadLimit limit(1);
        while (Work* const work = read_next()) {
            solve(*work);
            write(*work);
        }
    }

#ifdef SWIVEL_WITH_TBB

    // Reads, solves and writes chunks at once: one for each thread.
    void run_at_once()
    {
        using namespace oneapi::tbb;
        const int threads = static_cast<int>(threads_);
        const global_control more(global_control::max_allowed_parallelism, threads_ + kWaiting);
        // Chunks that carry state follow each other, each on all threads. Others are solved side by side.
        const bool in_order = cache_.crowd().carries_state();
        const filter_mode mode = in_order ? filter_mode::serial_in_order : filter_mode::parallel;
        std::counting_semaphore<> solvers(threads);
        task_arena arena(threads + kWaiting);
        arena.execute([&] {
            const auto read =
                make_filter<void, Work*>(filter_mode::serial_in_order, [&](flow_control& control) -> Work* {
                    Work* const work = read_next();
                    if (!work) control.stop();
                    return work;
                });
            const auto solved = make_filter<Work*, Work*>(mode, [&](Work* work) {
                solvers.acquire();
                const Release release{solvers};
                task_arena(in_order ? threads : 1).execute([&] { solve(*work); });
                return work;
            });
            const auto written = make_filter<Work*, void>(filter_mode::parallel, [&](Work* work) { write(*work); });
            parallel_pipeline(threads_ + kWaiting, read & solved & written);
        });
    }

#else

    void run_at_once() { run_in_turn(); }

#endif

    const Cache& cache_;
    const FillOptions& options_;
    unsigned threads_;  // that solve
    std::vector<ChunkAt> chunks_;
    std::size_t next_ = 0;
    std::optional<ChunkAt> read_last_;  // by read_next(), and so the last that was solved before the next
    Characters characters_;             // of that chunk's column
    std::mutex mutex_;                  // of all below
    // Chunks that were read and not yet written. They are not the pipeline's, which loses what it holds if a stage
    // throws.
    std::vector<std::unique_ptr<Work>> under_way_;
    std::vector<std::unique_ptr<Column>> columns_;  // that nobody solves with now
    std::uint64_t through_ = 0;
    FillReport report_;
};

}  // namespace

std::vector<ChunkAt> chunks_of(const CachedCrowd& crowd, const Shard& shard)
{
    std::vector<ChunkAt> chunks;
    std::uint64_t unit = 0;
    for (std::uint32_t column = 0; column < crowd.column_count(); ++column)
        for (std::uint32_t time = 0; time < crowd.time_count(); ++time) {
            if (unit % shard.count == shard.index) chunks.push_back({time, column});
            if (!crowd.carries_state() || time + 1 == crowd.time_count()) ++unit;
        }
    return chunks;
}

FillReport fill(const Cache& cache, const FillOptions& options) { return Filling(cache, options).run(); }

}  // namespace swivel::tools
