// SPDX-License-Identifier: MIT
//
// The promise: swivel_save() and swivel_load() carry all that a body's next solve starts from besides its inputs, and
// nothing else. So frames that are played again from a saved state have the same bits, in the same crowd and in a new
// one: with bodies left out by masks, feet in flight, heads on their way and a shift. The bytes are the documented ones
// on every CPU. swivel_state_digest() is of the same numbers. swivel_reset_body() lets bodies begin anew.
#include <algorithm>
#include <cstring>
#include <thread>

#include "tests/allocation_count.h"
#include "tests/hill_walkers.h"
#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr std::uint32_t kWalkers = 37;
constexpr swivel_features kCarrying =
    HillWalkers::kFeatures | SWIVEL_WITH_PLANT_ROTATION | SWIVEL_WITH_MAX_SWIVEL | SWIVEL_WITH_WEIGHTS;

// Groups: two legs, the second of which plants by its motion, a shift and a look.
enum : std::uint32_t { kLeft, kRight, kShift, kLook, kGroups };

using State = std::vector<std::byte>;

State saved(const Crowd& crowd)
{
    State state(kWalkers * swivel_state_bytes(crowd.get()));
    crowd.save(state);
    return state;
}

// Walkers with a spine and a head above the pelvis. A frame leaves out some bodies, others than the frame before.
struct Walkers : HillWalkers {
    Walkers() : HillWalkers(11, kWalkers, bumpy_field())
    {
        for (const std::int32_t parent : {0, 7}) {
            skeleton.parents.push_back(parent);
            skeleton.rotations.push_back({0, 0, 0, 1});
            skeleton.translations.push_back({0, 0.3f, 0});
        }
        go_to(0);
    }
    Crowd crowd() const
    {
        swivel_look_def look_def = look({7, 8});
        look_def.rate = 1;  // slow, so that heads are on their way for long
        std::uint32_t leg = 0;
        const auto edit = [&](swivel_body_limb_def& limb) {
            limb.plant = plant, limb.ground = ground;
            if (leg++ == kRight) limb.features |= SWIVEL_PLANT_BY_MOTION;
        };
        Crowd made = body_crowd(skeleton, kCarrying, kWalkers, edit, {shift_def, look_def});
        for (const std::uint32_t g : {std::uint32_t{kLeft}, std::uint32_t{kRight}}) {
            made.write_all(SWIVEL_EFFECTOR, g, kToe);
            made.write_all(SWIVEL_CAP, g, Float3{0.01f, 0.95f, 0});
            made.write_all(SWIVEL_MAX_SWIVEL, g, cos_sin(0.02));
        }
        return made;
    }
    static bool is_solved(int frame, std::uint32_t body) { return (frame * 7 + static_cast<int>(body) * 5) % 4 != 0; }
    // Solves one frame, and returns the poses. Bodies that are left out keep theirs.
    std::vector<unsigned char> play(Crowd& crowd, int frame, bool all = false)
    {
        go_to(frame);
        PoseBuffer buffer = poses();
        std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2);
        std::vector<Float3> targets;
        for (std::uint32_t n = 0; n < kWalkers; ++n) {
            if (all || is_solved(frame, n)) mask[n / 32] |= 1u << n % 32;
            int last = frame - 1;
            while (last >= 0 && !is_solved(last, n)) --last;
            times[n] = static_cast<float>((frame - last) * kWalkTime);
            const double a = 0.1 * frame + n;
            targets.push_back(floats(Vector3d(roots[n] + Vector3d(3 * std::sin(a), 2, 3 * std::cos(a)))));
        }
        write_labels(crowd);
        crowd.write(SWIVEL_LOOK_TARGET, kLook, targets);
        const swivel_pose pose = view(buffer);
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        job.mask = mask.data();
        job.mask_word_count = count_of(mask);
        job.sample = answer;
        job.sample_user = this;
        check(swivel_solve(crowd.get(), &job));
        return buffer.bytes;
    }
    Crowd played(int end)
    {
        Crowd crowd = this->crowd();
        for (int frame = 0; frame < end; ++frame) play(crowd, frame);
        return crowd;
    }
};

// Whether a number of a field is state: all that is carried, of a look's turns those of the joints that it has.
bool is_state(const swivel_field_info& info, std::uint32_t component)
{
    return info.kind == SWIVEL_FIELD_CARRIED && (info.field != SWIVEL_LOOK_TURNS || component < 1 + 3 * 2);
}

// Calls take(info, component, number) for each number of a body's results.
template <class Take>
void for_each_result(const Crowd& crowd, std::uint32_t group, std::uint32_t body, const Take& take)
{
    const swivel_rows rows = swivel_result_rows(crowd.get(), group);
    for (const swivel_field field : every_field()) {
        if (field < SWIVEL_INPUT_END) continue;
        const std::uint32_t first = swivel_field_first_row(crowd.get(), group, field);
        for (std::uint32_t c = 0; c < swivel_field_row_count(crowd.get(), group, field); ++c)
            take(describe(field), c, rows.base[((body / 16) * rows.row_count + first + c) * 16 + body % 16]);
    }
}
void flip_a_bit(float& number)
{
    std::uint32_t word;
    std::memcpy(&word, &number, sizeof word);
    word ^= 1;
    std::memcpy(&number, &word, sizeof word);
}

}  // namespace

TEST_CASE("ten frames that are rolled back and played again have the same bits, in the same crowd and in a new one")
{
    Walkers walkers;
    Crowd crowd = walkers.played(60);
    // Loaded where things are on their way.
    int planted = 0, in_flight = 0, turning = 0, shifting = 0;
    for (std::uint32_t n = 0; n < kWalkers; ++n) {
        const bool stands = flags_of(crowd, kLeft, n) & SWIVEL_PLANTED;
        planted += stands, in_flight += !stands;
        turning += (flags_of(crowd, kLook, n) & SWIVEL_LIMITED_STEP) != 0;
        shifting += value_of<Float3>(crowd, SWIVEL_SHIFT, kShift, n)[1] != 0;
    }
    REQUIRE((planted > 5 && in_flight > 5 && turning > 5 && shifting > 5));

    const State state = saved(crowd);
    const std::uint64_t digest = crowd.state_digest();
    std::vector<std::vector<unsigned char>> poses;
    std::vector<std::uint64_t> digests;
    for (int frame = 60; frame < 70; ++frame) {
        poses.push_back(walkers.play(crowd, frame));
        digests.push_back(crowd.state_digest());
    }
    const std::uint64_t results = crowd.digest();
    REQUIRE(crowd.state_digest() != digest);

    Crowd other = walkers.crowd();
    for (Crowd* const again : {&crowd, &other}) {
        again->load(state);
        REQUIRE(again->state_digest() == digest);
        REQUIRE(saved(*again) == state);
        for (int frame = 60; frame < 70; ++frame) {
            const std::size_t n = static_cast<std::size_t>(frame) - 60;
            REQUIRE(walkers.play(*again, frame) == poses[n]);
            REQUIRE(again->state_digest() == digests[n]);
        }
        REQUIRE(again->digest() == results);  // by now all bodies were solved
    }
}

TEST_CASE("every carried number is in the state, and no other number is")
{
    Walkers walkers;
    Crowd crowd = walkers.played(30);
    const State state = saved(crowd);
    const std::uint64_t digest = crowd.state_digest();
    const std::vector<std::uint32_t> words = all_words(crowd);
    const std::size_t each = swivel_state_bytes(crowd.get());
    std::vector<swivel_field> carried;
    std::size_t numbers = 0;
    for (const std::uint32_t body : {0u, 17u, kWalkers - 1})
        for (std::uint32_t g = 0; g < kGroups; ++g)
            for_each_result(crowd, g, body, [&](const swivel_field_info& info, std::uint32_t c, float& number) {
                const bool is_in = is_state(info, c);
                CAPTURE(body, g, info.name, c);
                flip_a_bit(number);
                State changed = saved(crowd);
                REQUIRE((crowd.state_digest() != digest) == is_in);
                REQUIRE((changed != state) == is_in);
                std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(body * each), each,
                            changed.begin() + static_cast<std::ptrdiff_t>(body * each));
                REQUIRE(changed == state);  // no other body's bytes have changed
                if (is_in) {
                    crowd.load(state);
                    carried.push_back(info.field);
                    ++numbers;
                } else {
                    flip_a_bit(number);
                }
                REQUIRE(all_words(crowd) == words);
            });
    CHECK(each == 4 * (1 + numbers / 3));
    for (const swivel_field field : every_field())
        if (describe(field).kind == SWIVEL_FIELD_CARRIED) CHECK(std::ranges::count(carried, field) > 0);

    for (std::uint32_t g = 0; g < kGroups; ++g) {  // inputs are the caller's
        const swivel_rows rows = swivel_input_rows(crowd.get(), g);
        std::fill_n(rows.base, float_count(rows), 7.0f);
    }
    CHECK((saved(crowd) == state && crowd.state_digest() == digest));
}

TEST_CASE("a solve starts from no result outside of the state")
{
    Walkers walkers;
    Crowd crowd = walkers.played(45), other = walkers.played(45);
    for (std::uint32_t g = 0; g < kGroups; ++g)
        for (std::uint32_t n = 0; n < kWalkers; ++n)
            for_each_result(other, g, n, [&](const swivel_field_info& info, std::uint32_t, float& number) {
                if (info.kind == SWIVEL_FIELD_RESULT) number = 1e20f;
            });
    REQUIRE(other.digest() != crowd.digest());
    REQUIRE(other.state_digest() == crowd.state_digest());
    REQUIRE(walkers.play(other, 45, true) == walkers.play(crowd, 45, true));
    REQUIRE(other.digest() == crowd.digest());
}

TEST_CASE("the state of some bodies goes to any others, and nothing allocates")
{
    Walkers walkers;
    const Crowd source = walkers.played(30);
    Crowd loaded = walkers.played(12);
    const Crowd before = walkers.played(12);
    const std::size_t each = swivel_state_bytes(source.get());
    State some(5 * each + 3);
    const std::size_t allocations = allocation_count();
    const swivel_status status[] = {swivel_save(source.get(), 14, 5, some.data() + 1, some.size() - 1),  // on no word
                                    swivel_load(loaded.get(), 29, 5, some.data() + 1, some.size() - 1),
                                    swivel_reset_body(loaded.get(), 2, 2)};
    const std::uint64_t digest = loaded.state_digest();
    CHECK(allocation_count() == allocations);
    for (const swivel_status each_status : status) CHECK(each_status == SWIVEL_OK);
    CHECK(digest != before.state_digest());
    CHECK((swivel_save(source.get(), kWalkers, 0, nullptr, 0) == SWIVEL_OK));
    CHECK((swivel_load(loaded.get(), 0, 0, nullptr, 0) == SWIVEL_OK));
    for (std::uint32_t g = 0; g < kGroups; ++g)
        for (std::uint32_t n = 0; n < kWalkers; ++n) {
            const auto carried = [&](const Crowd& crowd, std::uint32_t body) {
                return bits_of_group(crowd, g, body, SWIVEL_FIELD_CARRIED);
            };
            const std::vector<std::uint32_t> now = carried(loaded, n);
            if (n >= 29 && n < 34)
                REQUIRE(now == carried(source, n - 15));
            else if (n == 2 || n == 3)
                REQUIRE(now == std::vector<std::uint32_t>(now.size()));
            else
                REQUIRE(now == carried(before, n));
        }
}

TEST_CASE("bodies that are reset begin anew, as by a reset of each group")
{
    Walkers walkers;
    Crowd crowd = walkers.played(40), each = walkers.played(40), fresh = walkers.crowd();
    crowd.reset_bodies(7, 5);
    for (std::uint32_t g = 0; g < kGroups; ++g) check(swivel_reset(each.get(), g, 7, 5));
    REQUIRE(all_words(crowd) == all_words(each));
    for (Crowd* const next : {&crowd, &fresh}) walkers.play(*next, 75, true);
    int others = 0;
    for (std::uint32_t n = 0; n < kWalkers; ++n) {
        bool is_anew = true;
        for (std::uint32_t g = 0; g < kGroups; ++g)
            is_anew = is_anew && bits_of_group(crowd, g, n) == bits_of_group(fresh, g, n);
        if (n >= 7 && n < 12) {
            REQUIRE(is_anew);
            REQUIRE(value_of<Float3>(crowd, SWIVEL_SHIFT, kShift, n)[1] == 0);  // at its goal
            REQUIRE((flags_of(crowd, kLook, n) & SWIVEL_LIMITED_STEP) == 0);
        } else {
            others += !is_anew;
        }
    }
    CHECK(others > 25);
}

TEST_CASE("bytes are words of a layout and of floats, the low byte first")
{
    swivel_limb_def limb = limbs(3, SWIVEL_WITH_MAX_SWIVEL);
    Crowd crowd(limb);
    REQUIRE(swivel_state_bytes(crowd.get()) == 16);
    crowd.write_all(SWIVEL_NORMAL, 0, Float3{1, -2, 0.5f});
    std::array<unsigned char, 48> bytes;
    check(swivel_save(crowd.get(), 0, 3, bytes.data(), bytes.size()));
    const std::array<unsigned char, 12> floats = {0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0x3f};
    for (std::size_t n = 0; n < 3; ++n) {
        CHECK(std::equal(floats.begin(), floats.end(), &bytes[16 * n + 4]));
        CHECK(std::equal(&bytes[0], &bytes[4], &bytes[16 * n]));
    }
    std::array<unsigned char, 48> other;
    std::thread beside([&] { check(swivel_save(crowd.get(), 0, 3, other.data(), other.size())); });
    check(swivel_save(crowd.get(), 0, 3, bytes.data(), bytes.size()));
    beside.join();
    CHECK(other == bytes);
}

TEST_CASE("free limbs that keep their pose have it in the state, but for their flags; others do not")
{
    for (const swivel_on_bad_input on_bad_input : {SWIVEL_KEEP_POSE, SWIVEL_REST_POSE}) {
        swivel_limb_def limb = limbs(20, SWIVEL_WITH_HAND | SWIVEL_WITH_REACH);
        limb.on_bad_input = on_bad_input;
        const auto made = [&] {
            Crowd crowd({limb, limb});
            for (const std::uint32_t g : {0u, 1u}) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
            return crowd;
        };
        Crowd crowd = made(), other = made();
        for (const std::uint32_t g : {0u, 1u}) crowd.write_all(SWIVEL_TARGET, g, {0.3f, 0.4f, 0.5f});
        crowd.solve();
        const bool keeps = on_bad_input == SWIVEL_KEEP_POSE;
        const std::size_t numbers = keeps ? 2 * (4 + 2 + 4 + 1) : 0;
        REQUIRE(swivel_state_bytes(crowd.get()) == 4 + 4 * numbers);
        State state(20 * swivel_state_bytes(crowd.get()));
        crowd.save(state);
        other.load(state);
        CHECK(other.state_digest() == crowd.state_digest());
        for (Crowd* const each : {&crowd, &other}) {
            for (const std::uint32_t g : {0u, 1u}) each->write_all(SWIVEL_TARGET, g, Float3{kNan, 0, 0});
            each->solve();
        }
        CHECK(other.digest() == crowd.digest());
        CHECK((value_of<Float4>(other, SWIVEL_SHOULDER, 1, 19) == Float4{0, 0, 0, 1}) == !keeps);
    }
}

TEST_CASE("the state of another kind of crowd is refused, and nothing of it is loaded")
{
    const auto made = [](swivel_features first, swivel_features second) {
        return Crowd({limbs(3, first), limbs(3, second)});
    };
    const Crowd plain = made(0, 0), mixed = made(SWIVEL_WITH_MAX_SWIVEL, 0), turned = made(0, SWIVEL_WITH_MAX_SWIVEL);
    Crowd crowd = made(SWIVEL_WITH_MAX_SWIVEL, 0);
    CHECK((swivel_state_bytes(plain.get()) == 4 && swivel_state_bytes(mixed.get()) == 16));
    State states(3 * 16);
    crowd.write_all(SWIVEL_NORMAL, 0, Float3{1, 2, 3});
    crowd.save(states);
    check(swivel_save(turned.get(), 2, 1, &states[32], 16));
    crowd.write_all(SWIVEL_NORMAL, 0, Float3{4, 5, 6});
    const std::vector<std::uint32_t> words = all_words(crowd);
    CHECK_REFUSED(swivel_load(crowd.get(), 0, 3, states.data(), states.size()), SWIVEL_INVALID_ARGUMENT);
    CHECK(std::string(swivel_last_error()).find("state 2 is of another kind of crowd") != std::string::npos);
    CHECK(all_words(crowd) == words);
    CHECK(swivel_load(crowd.get(), 0, 2, states.data(), states.size()) == SWIVEL_OK);
    CHECK(value_of<Float3>(crowd, SWIVEL_NORMAL, 0, 1) == Float3{1, 2, 3});
    CHECK(value_of<Float3>(crowd, SWIVEL_NORMAL, 0, 2) == Float3{4, 5, 6});
    CHECK((swivel_state_bytes(nullptr) == 0 && swivel_state_digest(nullptr) == 0));
    CHECK(swivel_state_bytes(Crowd({limbs(3), limbs(4)}).get()) == 0);
}
