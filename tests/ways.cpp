// SPDX-License-Identifier: MIT
#include "tests/ways.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <list>
#include <numeric>
#include <thread>

#include "tests/test_random.h"
#include "tests/test_scopes.h"
#include "tests/way_memory.h"

namespace swivel::test {

namespace {

using LimbLists = std::vector<Limbs>;  // of each group

std::uint32_t group_count(const Crowd& crowd) { return swivel_group_count(crowd.get()); }
std::uint32_t limb_count(const Crowd& crowd, std::uint32_t group)
{
    return swivel_group_limb_count(crowd.get(), group);
}
std::uint32_t size_of(const Crowd& crowd, std::uint32_t group, swivel_field field)
{
    return swivel_field_row_count(crowd.get(), group, field);
}
// The fields that a group has.
std::vector<swivel_field_info> fields_of(const Crowd& crowd, std::uint32_t group)
{
    std::vector<swivel_field_info> fields;
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if (size_of(crowd, group, info.field) > 0) fields.push_back(info);
    return fields;
}
// The words of a field, limb by limb.
std::vector<std::uint32_t> read_words(const Crowd& crowd, std::uint32_t group, swivel_field field)
{
    const std::size_t size = size_of(crowd, group, field);
    std::vector<std::uint32_t> words(limb_count(crowd, group) * size);
    check(swivel_read(crowd.get(), field, group, 0, limb_count(crowd, group), {words.data(), 4 * size}));
    return words;
}
void write_words(Crowd& crowd, std::uint32_t group, swivel_field field, const std::vector<std::uint32_t>& words)
{
    const std::size_t size = size_of(crowd, group, field);
    check(swivel_write(crowd.get(), field, group, 0, limb_count(crowd, group), {words.data(), 4 * size}));
}

// Of any bytes, for one job at a time.
struct Workspace {
    std::vector<char> bytes;

    explicit Workspace(const Crowd& crowd) : bytes(swivel_workspace_bytes(crowd.get()) + 64, '\xff') {}
    void* first() const
    {
        const auto place = reinterpret_cast<std::uintptr_t>(bytes.data());
        return reinterpret_cast<void*>((place + 63) / 64 * 64);
    }
};

// Some limbs of each group, solved in a crowd of their own.
class Part {
public:
    Part(Scene& scene, const Crowd& from, const Job& from_job, const LimbLists& limbs, const Way& way)
        : crowd(crowd_for(scene, limbs)), from_(from), from_job_(from_job), limbs_(limbs), way_(way)
    {
        for (std::uint32_t g = 0; g < limbs.size(); ++g) copy_rows(g);
        if (!from_job.streams.empty() || way.has_frames || way.is_far) take_frames();
        if (!from_job.pose) return;
        take_pose(scene.joint_count);
        job.pose = &pose_;
    }
    // Each of the limbs that the job chooses.
    void solve()
    {
        const auto solve_those = [&](const auto& are_chosen) {
            Limbs some;
            std::ranges::copy_if(chosen(), std::back_inserter(some), are_chosen);
            if (way_.jobs == Way::Jobs::masks || from_job_.mask) choose(some);
            solve_some(some);
        };
        switch (way_.jobs) {
            case Way::Jobs::one:
                return solve_those([](std::uint32_t) { return true; });
            case Way::Jobs::threads:
                return solve_on_threads();
            case Way::Jobs::blocks: {
                const Workspace workspace(crowd);
                job.on_this_thread = true, job.workspace = workspace.first();
                for (std::uint32_t block = swivel_block_count(crowd.get()); block-- > 0;) {
                    job.blocks = swivel_blocks{block, 1};
                    solve_those([&](std::uint32_t limb) { return limb / SWIVEL_LANES == block; });
                }
                return;
            }
            case Way::Jobs::masks:  // a half, and of large crowds a few; then the others
                for (const bool are_first : {true, false})
                    solve_those([&](std::uint32_t limb) {
                        return (limb < 256 ? limb * 7 / 5 % 2 == 0 : limb % 50 == 0) == are_first;
                    });
        }
    }
    Crowd& crowd;
    Job job;

private:
    static Crowd& crowd_for(Scene& scene, const LimbLists& limbs)
    {
        Scene::LimbCounts counts;
        for (const Limbs& list : limbs) counts.push_back(static_cast<std::uint32_t>(list.size()));
        return scene.crowd_of(counts);
    }
    Values& add(std::uint32_t g, std::size_t joint_count, std::size_t size)
    {
        return values_.emplace_back(swivel_group_first_limb(crowd.get(), g), limbs_[g].size(), joint_count, size,
                                    way_.memory);
    }
    void copy_rows(std::uint32_t g)
    {
        const swivel_rows rows = swivel_result_rows(crowd.get(), g);
        for (const swivel_field_info& field : fields_of(from_, g)) {
            const std::uint32_t size = size_of(from_, g, field.field);
            const std::vector<std::uint32_t> all = read_words(from_, g, field.field);
            std::vector<std::uint32_t> some;
            for (const std::uint32_t limb : limbs_[g])
                some.insert(some.end(), &all[limb * size], &all[limb * size] + size);
            if (field.kind != SWIVEL_FIELD_RESULT) {
                write_words(crowd, g, field.field, some);
                continue;
            }
            // Limbs with bad input may keep them, and no call writes them.
            const std::size_t first = swivel_field_first_row(crowd.get(), g, field.field);
            for (std::size_t n = 0; n < some.size(); ++n) {
                const std::size_t limb = n / size, row = limb / SWIVEL_LANES * rows.row_count + first + n % size;
                std::memcpy(&rows.base[row * SWIVEL_LANES + limb % SWIVEL_LANES], &some[n], sizeof some[n]);
            }
        }
    }
    void take_frames()
    {
        const bool is_far_already = from_job_.pose && from_job_.pose->root_is_double;
        frames_.resize(limbs_.size());
        for (std::uint32_t g = 0; g < limbs_.size(); ++g) {
            if (way_.is_far && !from_job_.pose) frames_[g].origin({kFar.data(), 0});
            for (const swivel_field_info& field : fields_of(crowd, g)) {
                if (field.kind != SWIVEL_FIELD_INPUT) continue;
                const bool is_double = is_far_already && field.is_position;
                if (const swivel_stream* const given = given_field(g, field.field))
                    take_given(g, *given, is_double ? 24 : 4 * size_of(crowd, g, field.field));
                else if (way_.is_far || (way_.has_frames && !is_double))
                    take_from_rows(g, field);
            }
        }
        job.streams.assign(frames_.begin(), frames_.end());
    }
    const swivel_stream* given_field(std::uint32_t g, swivel_field field) const
    {
        if (from_job_.streams.empty()) return nullptr;
        const swivel_streams& frame = from_job_.streams[g];
        for (std::uint32_t n = 0; n < frame.field_count; ++n)
            if (frame.fields[n].data && frame.fields[n].field == field) return &frame.fields[n];
        return nullptr;
    }
    void take_given(std::uint32_t g, const swivel_stream& given, std::size_t size)
    {
        Values& made = add(g, 1, size);
        for (std::size_t n = 0; n < limbs_[g].size(); ++n)
            made.put(n, static_cast<const char*>(given.data) + limbs_[g][n] * given.stride);
        made.come();
        frames_[g].in(given.field, made.in());
    }
    // Takes them out of the rows, which have no number then.
    void take_from_rows(std::uint32_t g, const swivel_field_info& field)
    {
        std::vector<std::uint32_t> words = read_words(crowd, g, field.field);
        const std::size_t size = size_of(crowd, g, field.field);
        const bool is_far = way_.is_far && field.is_position;
        const swivel_features directions = SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL;  // which have no origin
        const bool has_origin = field.field != SWIVEL_POLE || !(swivel_group_features(crowd.get(), g) & directions);
        Values& made = add(g, 1, is_far ? 24 : 4 * size);
        for (std::size_t n = 0; n < limbs_[g].size(); ++n)
            is_far ? made.put_far(n, &words[n * size], has_origin) : made.put(n, &words[n * size]);
        made.come();
        frames_[g].in(field.field, made.in());
        std::ranges::fill(words, 0x7fc05a5au);  // NaN
        write_words(crowd, g, field.field, words);
    }
    void take_pose(std::size_t joint_count)
    {
        swivel_pose from = *from_job_.pose;
        if (way_.is_apart && !from.results.data) {
            from.results = from.rotations;
            if (from.space == SWIVEL_IN_BODY) from.translation_results = from.translations;
        }
        pose_ = from;
        pose_.root_is_double = from.root_is_double || way_.is_far;
        for (const JointArray& each : joint_arrays(from)) {
            Values& made = add(0, joint_count, each.size);
            for (std::size_t n = 0; n < limbs_[0].size(); ++n)
                for (std::size_t joint = 0; joint < joint_count; ++joint)
                    std::memcpy(made.at(n, joint), value_at(from.*each.values, limbs_[0][n], joint), each.size);
            made.come();
            pose_.*each.values = made.joints();
            if (each.is_written) written_.push_back(&made);
        }
        for (const BodyArray& each : kBodyArrays) {
            const bool is_moved = way_.is_far && each.is_position;
            static constexpr float origin[3] = {0, 0, 0};
            const swivel_in values = is_moved && !(from.*each.values).data ? swivel_in{origin, 0} : from.*each.values;
            if (!values.data) continue;
            Values& made = add(0, 1, each.is_position && pose_.root_is_double ? 24 : each.size);
            for (std::size_t n = 0; n < limbs_[0].size(); ++n) {
                const char* const value = static_cast<const char*>(values.data) + limbs_[0][n] * values.stride;
                is_moved ? made.put_far(n, value) : made.put(n, value);
            }
            made.come();
            pose_.*each.values = made.in();
        }
    }

    // The numbers of the chosen limbs in this crowd, each once. Those of a body are one.
    Limbs chosen() const
    {
        Limbs numbers;
        for (std::uint32_t g = 0; g < limbs_.size(); ++g)
            for (std::uint32_t n = 0; n < limbs_[g].size(); ++n) {
                const std::uint32_t number = swivel_group_first_limb(from_.get(), g) + limbs_[g][n];
                if (!from_job_.mask || (*from_job_.mask)[number / 32] >> number % 32 & 1)
                    numbers.push_back(swivel_group_first_limb(crowd.get(), g) + n);
            }
        std::ranges::sort(numbers);
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        return numbers;
    }
    // The job chooses these by a mask.
    void choose(const Limbs& limbs)
    {
        mask_.assign((swivel_block_count(crowd.get()) + 1) / 2, 0);
        for (const std::uint32_t limb : limbs) mask_[limb / 32] |= 1u << limb % 32;
        job.mask = mask_;
    }
    // In turns. Ranges end between a mask's words.
    void solve_on_threads()
    {
        constexpr std::uint32_t kThreads = 3, kBlocks = 7;
        const std::uint32_t end = swivel_block_count(crowd.get());
        if (from_job_.mask) choose(chosen());
        job.on_this_thread = true;
        std::vector<std::thread> threads;
        for (std::uint32_t n = 0; n < kThreads; ++n)
            threads.emplace_back([&, n] {
                const Workspace workspace(crowd);
                Job own = job;
                own.workspace = workspace.first();
                for (std::uint32_t first = n * kBlocks; first < end; first += kThreads * kBlocks) {
                    own.blocks = swivel_blocks{first, std::min(kBlocks, end - first)};
                    crowd.solve(own);
                }
            });
        for (std::thread& thread : threads) thread.join();
    }
    // In one job.
    void solve_some(const Limbs& limbs)
    {
        bool is_kept = true;
        for (Values& values : values_) is_kept = values.protect_others(limbs, PROT_NONE) && is_kept;
        const std::uint32_t count = solve_there();
        for (Values& values : values_) {
            is_kept = values.protect_others(limbs, PROT_READ | PROT_WRITE) && is_kept;
            is_kept = values.is_as_it_came(std::ranges::find(written_, &values) != written_.end()) && is_kept;
        }
        REQUIRE(count == limbs.size());
        REQUIRE(is_kept);
    }
    std::uint32_t solve_there()
    {
        if (!way_.is_in_other_environment) return crowd.solve(job);
        const OtherEnvironment other;
        return crowd.solve(job);
    }

    const Crowd& from_;
    const Job& from_job_;
    const LimbLists& limbs_;
    const Way& way_;
    std::list<Values> values_;
    std::vector<const Values*> written_;  // those that a solve writes
    std::vector<Streams> frames_;
    std::vector<std::uint32_t> mask_;
    swivel_pose pose_;
};

// The limbs of each crowd that a way takes.
std::vector<LimbLists> parts_of(const Crowd& crowd, bool is_shuffled)
{
    LimbLists all(group_count(crowd));
    for (std::uint32_t g = 0; g < all.size(); ++g) {
        all[g].resize(limb_count(crowd, g));
        std::iota(all[g].begin(), all[g].end(), 0u);
        Random random{all[g].size()};  // bodies are in the same order in all groups
        for (std::uint32_t n = limb_count(crowd, g); is_shuffled && n > 1; --n)
            std::swap(all[g][n - 1], all[g][random.below(n)]);
    }
    if (!is_shuffled) return {all};
    std::vector<LimbLists> parts;
    for (std::size_t first = 0, end = 1; first < limb_count(crowd, 0); first = end, end = 5 * end + 1) {
        parts.emplace_back(all.size());
        for (std::size_t g = 0; g < all.size(); ++g)
            for (std::size_t n = first; n < std::min<std::size_t>(end, limb_count(crowd, 0)); ++n)
                parts.back()[g].push_back(all[g][n % all[g].size()]);  // small groups are solved again and again
    }
    return parts;
}

// Says where something is, in the space of the target.
bool is_place(swivel_field field)
{
    constexpr swivel_field places[] = {SWIVEL_RECORD,         SWIVEL_SOLVED_GOAL,    SWIVEL_PROBE,
                                       SWIVEL_HAND_TRANSFORM, SWIVEL_PROP_TRANSFORM, SWIVEL_SIGHT};
    return std::ranges::find(places, field) != std::end(places);
}

}  // namespace

Bits bits_after(const Scene& scene, const Crowd& crowd, const Job& job, bool has_places)
{
    Bits bits;
    for (std::uint32_t g = 0; g < group_count(crowd); ++g) {
        auto& limbs = bits.emplace_back(limb_count(crowd, g));
        for (const swivel_field_info& field : fields_of(crowd, g)) {
            if (field.kind == SWIVEL_FIELD_INPUT || (!has_places && is_place(field.field))) continue;
            const std::vector<std::uint32_t> words = read_words(crowd, g, field.field);
            const std::size_t size = size_of(crowd, g, field.field);
            for (std::size_t n = 0; n < limbs.size(); ++n)
                limbs[n].insert(limbs[n].end(), &words[n * size], &words[n * size] + size);
        }
    }
    if (!job.pose) return bits;
    auto& bodies = bits.emplace_back(limb_count(crowd, 0));
    for (std::size_t n = 0; n < bodies.size(); ++n)
        for (const JointArray& each : joint_arrays(*job.pose))
            for (std::size_t joint = 0; each.is_written && joint < scene.joint_count; ++joint) {
                std::array<std::uint32_t, 16> words;
                std::memcpy(words.data(), value_at(job.pose->*each.values, n, joint), each.size);
                bodies[n].insert(bodies[n].end(), words.begin(), words.begin() + each.size / sizeof words[0]);
            }
    return bits;
}

Bits bits_of_way(Scene& scene, const Crowd& crowd, const Job& job, const Way& way)
{
    Bits bits;
    for (std::uint32_t g = 0; g < group_count(crowd); ++g) bits.emplace_back(limb_count(crowd, g));
    if (job.pose) bits.emplace_back(limb_count(crowd, 0));
    for (const LimbLists& limbs : parts_of(crowd, way.is_shuffled)) {
        Part part(scene, crowd, job, limbs, way);
        part.solve();
        const Bits of_part = bits_after(scene, part.crowd, part.job, !way.is_far);
        for (std::size_t g = 0; g < bits.size(); ++g) {
            const Limbs& list = limbs[g < limbs.size() ? g : 0];  // the last are bodies
            for (std::size_t n = 0; n < list.size(); ++n) bits[g][list[n]] = of_part[g][n];
        }
    }
    return bits;
}

void shorten_positions(Crowd& crowd, const Job& job)
{
    const auto shorten = [](float& x) {
        if (std::fabs(x) > 1e6f) x = 1;
        x = std::round(x * 65536) / 65536 + 0.0f;  // no -0, either
    };
    for (std::uint32_t g = 0; g < group_count(crowd); ++g)
        for (const swivel_field_info& field : fields_of(crowd, g)) {
            const bool shifts = field.field == SWIVEL_PELVIS_FIT_WEIGHT || field.field == SWIVEL_SHIFT_WISH;
            if (!field.is_position && !shifts) continue;
            std::vector<std::uint32_t> words = read_words(crowd, g, field.field);
            for (std::uint32_t& word : words) {
                float x = 0;
                std::memcpy(&x, &word, sizeof x);
                shifts ? void(x = 0) : shorten(x);
                std::memcpy(&word, &x, sizeof x);
            }
            write_words(crowd, g, field.field, words);
        }
    if (!job.pose) return;
    for (const swivel_in& places : {job.pose->root_position, job.pose->support_position})
        for (std::size_t n = 0; places.data && n < limb_count(crowd, 0); ++n) {
            auto* const place = const_cast<float*>(static_cast<const float*>(places.data)) + n * places.stride / 4;
            std::for_each(place, place + 3, shorten);
        }
}

}  // namespace swivel::test
