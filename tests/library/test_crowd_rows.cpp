// SPDX-License-Identifier: MIT
//
// The promise: a crowd's memory is taken once, from whom it was told to, and nothing allocates afterwards. Groups and
// fields lie in its rows as swivel.h's table and swivel_describe_field() say. The test `interface` has streams into and
// out of them.
#include <bit>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>

#include "simd/fields.h"
#include "tests/allocation_count.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tools/corpus/corpus.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/task_arena.h>
#endif

using namespace swivel;
using namespace swivel::test;

TEST_CASE("groups start blocks, fields are rows in the order of the table")
{
    const swivel_limb_def groups[] = {group_of(1), group_of(16), group_of(17), group_of(40)};
    const std::uint32_t first_limbs[] = {0, 16, 32, 64};
    for (const swivel_features features : every_plain_set()) {
        const Crowd crowd = crowd_with(features, groups);
        INFO("features " << features);
        CHECK(swivel_block_count(crowd.get()) == 7);
        for (std::uint32_t g = 0; g < 4; ++g) {
            CHECK(swivel_group_first_limb(crowd.get(), g) == first_limbs[g]);
            CHECK(swivel_group_limb_count(crowd.get(), g) == groups[g].limb_count);
        }
        std::uint32_t row = 0;
        for (const swivel_field field : every_field()) {
            if (field == SWIVEL_SHOULDER) {
                CHECK(swivel_input_rows(crowd.get(), 0).row_count == row);
                row = 0;
            }
            const std::uint32_t size = swivel_field_row_count(crowd.get(), 0, field);
            if (size) CHECK(swivel_field_first_row(crowd.get(), 0, field) == row);
            row += size;
        }
        CHECK(swivel_result_rows(crowd.get(), 0).row_count == row);
        CHECK(swivel_field_row_count(crowd.get(), 0, SWIVEL_INPUT_END) == 0);
        CHECK(swivel_result_rows(crowd.get(), 3).block_count == (groups[3].limb_count + 15) / 16);
        for (const swivel_rows rows : {swivel_input_rows(crowd.get(), 0), swivel_result_rows(crowd.get(), 0)})
            CHECK(reinterpret_cast<std::uintptr_t>(rows.base) % 64 == 0);
    }
}

TEST_CASE("a new crowd's inputs are what anybody would guess, and else bad")
{
    swivel_limb_def groups[] = {group_of(20), group_of(5)};
    std::ranges::copy(Float2{0.3f, 0}, groups[1].binding.lengths);
    for (const bool joints : {false, true}) {
        const swivel_features features = SWIVEL_WORLD | SWIVEL_WITH_HAND | (joints ? SWIVEL_JOINTS : 0);
        const Crowd crowd = crowd_with(features, groups);
        for (const swivel_field field : {SWIVEL_TARGET, SWIVEL_SHOULDER_POSITION})
            for (const Float3& value : read<Float3>(crowd, field, 0))
                for (const float x : value) CHECK(std::isnan(x));
        CHECK(read<Float4>(crowd, SWIVEL_PARENT_ROTATION)[19] == Float4{0, 0, 0, 1});
        CHECK(read<Float1>(crowd, SWIVEL_PARENT_SCALE)[19] == Float1{1});
        CHECK(read<Float4>(crowd, SWIVEL_HAND)[19] == Float4{0, 0, 0, 1});
        for (const Float2& lengths : read<Float2>(crowd, SWIVEL_LENGTHS, 1)) {
            if (joints)
                CHECK(lengths == Float2{0.3f, 0});
            else
                CHECK((std::isnan(lengths[0]) && std::isnan(lengths[1])));
        }
    }
}

namespace {

// swivel_digest() as docs/fields.md describes it, by limbs and their values: floats of rows by swivel.h's layout.
std::uint64_t described_digest(const Crowd& crowd)
{
    std::uint64_t hashes[SWIVEL_LANES] = {}, whole = 0;
    const auto step = [](std::uint64_t& hash, std::uint64_t number) {
        const std::uint64_t product = (hash ^ number) * 0x9e3779b97f4a7c15u;
        hash = product ^ product >> 32;
    };
    for (std::uint32_t g = 0; g < swivel_group_count(crowd.get()); ++g) {
        const swivel_rows floats = swivel_result_rows(crowd.get(), g);
        const std::uint32_t row_count = floats.row_count;
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), g); ++n)
            for (std::uint32_t row = 0; row < row_count; ++row) {
                const std::size_t at = (std::size_t{n / 16} * row_count + row) * 16 + n % 16;
                step(hashes[n % 16], std::bit_cast<std::uint32_t>(floats.base[at]));
            }
    }
    for (const std::uint64_t hash : hashes) step(whole, hash);
    return whole;
}

}  // namespace

TEST_CASE("the digest is that of the results, and of nothing else")
{
    const std::uint32_t counts[] = {1, 16, 37};
    for (const swivel_features features : {swivel_features{0}, SWIVEL_JOINTS | SWIVEL_WITH_HAND}) {
        INFO("features " << features);
        std::vector<swivel_limb_def> groups;
        for (const std::uint32_t count : counts) groups.push_back(group_of(count));
        Crowd crowd = crowd_with(features, groups);
        Random random{7};
        CHECK(crowd.digest() == described_digest(crowd));
        for (int n = 0; n < 20; ++n) {
            for (std::uint32_t g = 0; g < 3; ++g) {
                std::vector<Float3> targets(counts[g]);
                for (Float3& target : targets) target = floats(random.vector(0, 2));
                crowd.write(SWIVEL_TARGET, g, targets);
                crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 0.75f});
            }
            const std::uint64_t before = crowd.digest();
            crowd.solve();
            CHECK(crowd.digest() == described_digest(crowd));
            CHECK(crowd.digest() != before);
        }
    }
    CHECK(swivel_digest(nullptr) == 0);
}

namespace {

// Whether a group has a field, as far as the library describes it.
bool is_of(const swivel_field_info& field, swivel_kind kind, swivel_features features)
{
    return field.kinds >> kind & 1 && (features & field.needs) == field.needs && !(features & field.excludes);
}

}  // namespace

TEST_CASE("the library describes the fields, features and flags that the header has")
{
    std::ifstream file(SWIVEL_SOURCE_DIR "/include/swivel/swivel.h");  // which has all of these
    const std::string header{std::istreambuf_iterator<char>(file), {}};
    const auto lower = [](std::string name) {
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return name;
    };
    const auto names_in = [&](const std::string& text, const std::regex& pattern) {
        std::vector<std::string> names;
        for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
            names.push_back((*at)[1]);
        return names;
    };
    const std::string fields =
        header.substr(header.find("typedef enum swivel_field {"),
                      header.find("} swivel_field;") - header.find("typedef enum swivel_field {"));
    std::vector<std::string> wanted;
    for (const std::string& name : names_in(fields, std::regex(R"(\n    SWIVEL_(\w+)(?: = \d+)?,)")))
        wanted.push_back(lower(name));
    std::erase(wanted, "input_end");
    std::vector<std::string> got;
    swivel_field_info field;
    for (std::uint32_t n = 0; swivel_describe_field(n, &field); ++n) {
        got.push_back(field.name);
        const bool is_input = field.field < SWIVEL_INPUT_END;
        CHECK((field.kind == SWIVEL_FIELD_INPUT) == is_input);
        constexpr std::array carried = {SWIVEL_NORMAL, SWIVEL_PLANT, SWIVEL_PLANT_ROTATION, SWIVEL_CONTACT_STATE,
                                        SWIVEL_SHIFT,  SWIVEL_LIFT,  SWIVEL_LOOK_TURNS};
        CHECK((field.kind == SWIVEL_FIELD_CARRIED) == (std::ranges::find(carried, field.field) != carried.end()));
        CHECK((*field.range != 0) == is_input);
    }
    CHECK(got == wanted);
    // Tests find fields by these words, which are those of values with such parts.
    constexpr struct {
        const char* function;
        ValuePart parts[2];
    } makers[] = {{"swivel_cos_sin()", {ValuePart::turn, ValuePart::half_turn}},
                  {"swivel_flexion()", {ValuePart::flexion}},
                  {"swivel_cone()", {ValuePart::cosine}},
                  {"swivel_aim()", {ValuePart::right_turn}},
                  {"swivel_range()", {ValuePart::range}}};
    for (const FieldRow& row : kFields)
        for (const auto& maker : makers) {
            const bool has_part = std::ranges::any_of(row.value.parts, [&](ValuePart part) {
                return part != ValuePart::none && std::ranges::count(maker.parts, part) > 0;
            });
            INFO(row.name << ", " << maker.function);
            CHECK(is_made_by(maker.function, row.field) == has_part);
        }
    // A group has a field just if it is of its kinds, has what the field needs and lacks what it excludes. Further,
    // some have twist bones, a solved goal is that of a plant or a link, and a hand that others hold has its transform.
    for (const corpus::Part part : corpus::kParts)
        for (const corpus::Recipe& recipe : corpus::recipes_of(part)) {
            const Crowd crowd = make_crowd(recipe, 1);
            for (std::uint32_t g = 0; g < swivel_group_count(crowd.get()); ++g)
                for (std::uint32_t n = 0; swivel_describe_field(n, &field); ++n) {
                    INFO(full_name(recipe) << ", " << field.name);
                    const swivel_features features = swivel_group_features(crowd.get(), g);
                    const swivel_kind kind = swivel_group_kind(crowd.get(), g);
                    const std::uint32_t rows = swivel_field_row_count(crowd.get(), g, field.field);
                    const bool is_described = is_of(field, kind, features);
                    if (field.field == SWIVEL_TWIST_BONES)
                        CHECK((rows == 0 || is_described));
                    else if (field.field == SWIVEL_HAND_TRANSFORM)
                        CHECK((rows > 0 || !is_described));
                    else if (field.field == SWIVEL_SOLVED_GOAL)
                        CHECK((rows > 0) == (is_described && (features & (SWIVEL_WITH_PLANT | SWIVEL_WITH_LINK)) != 0));
                    else
                        CHECK((rows > 0) == is_described);
                    CHECK(rows <= field.max_components);
                }
        }
    got.clear();
    swivel_feature_info feature;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &feature); ++n) got.push_back(feature.name);
    wanted = names_in(header, std::regex(R"(\n#define SWIVEL_(\w+)[ \\\n]+\(UINT64_C\()"));
    std::ranges::sort(got), std::ranges::sort(wanted);
    CHECK(got == wanted);
    std::vector<std::string> flags;
    for (std::uint32_t bit = 0; bit < 32; ++bit)
        if (const char* const name = swivel_flag_name(1u << bit)) flags.push_back(name);
    CHECK(flags == names_in(header, std::regex(R"(\n    SWIVEL_(\w+) = 1u << \d+,)")));
    CHECK(!swivel_flag_name(0));
    CHECK(std::string(swivel_flag_name(SWIVEL_BAD_INPUT | SWIVEL_REACHED)) == "REACHED");
    CHECK(!swivel_describe_field(0, nullptr));
    CHECK(!swivel_describe_feature(1000, &feature));
    // The widest values: those of all groups, and those that groups give in several widths.
    const std::map<swivel_field, std::uint32_t> widths = {
        {SWIVEL_TARGET, 3}, {SWIVEL_SHOULDER_BOX, 12}, {SWIVEL_CLAVICLE, 4}, {SWIVEL_ELBOW, 4},
        {SWIVEL_FLAGS, 1},  {SWIVEL_TWIST_BONES, 28},  {SWIVEL_SHIFT, 3},    {SWIVEL_PROP_TRANSFORM, 7},
        {SWIVEL_SIGHT, 6},  {SWIVEL_LOOK_TURNS, 25}};
    for (std::uint32_t n = 0; swivel_describe_field(n, &field); ++n)
        if (const auto width = widths.find(field.field); width != widths.end()) {
            INFO(field.name);
            CHECK(field.max_components == width->second);
        }
}

namespace {

struct Ledger {
    std::size_t taken = 0, given_back = 0, bytes = 0, alignment = 0;
    void* memory = nullptr;
    bool empty = false;
};

}  // namespace

TEST_CASE("a crowd takes swivel_crowd_bytes() once, from whom it was told to")
{
    swivel_limb_def limb_defs[] = {group_of(100), group_of(3), group_of(50)};
    const swivel_group_def groups[] = {c_group(limb_defs[0]), c_group(limb_defs[1]), c_group(limb_defs[2])};
    for (const swivel_features features : every_plain_set()) {
        INFO("features " << features);
        swivel_crowd_def def = def_of(groups[0]);
        def.group_count = 3;
        for (swivel_limb_def& limb : limb_defs) limb.features = features;
        const std::size_t bytes = swivel_crowd_bytes(&def);
        REQUIRE(bytes % 64 == 0);

        Ledger ledger;
        def.user = &ledger;
        def.allocate = [](std::size_t size, std::size_t alignment, void* user) {
            Ledger& l = *static_cast<Ledger*>(user);
            ++l.taken;
            l.bytes = size;
            l.alignment = alignment;
            return l.memory = l.empty ? nullptr : std::aligned_alloc(alignment, size);
        };
        def.release = [](void* memory, std::size_t size, void* user) {
            Ledger& l = *static_cast<Ledger*>(user);
            l.given_back += memory == l.memory && size == l.bytes;
            std::free(memory);
        };
        {
            Crowd crowd(def);
            crowd.solve();
            CHECK(ledger.given_back == 0);
        }
        CHECK(ledger.taken == 1);
        CHECK(ledger.bytes == bytes);
        CHECK(ledger.alignment == 64);
        CHECK(ledger.given_back == 1);

        ledger.empty = true;
        swivel_crowd* crowd = reinterpret_cast<swivel_crowd*>(8);
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_OUT_OF_MEMORY);
        CHECK(crowd == nullptr);

        // The caller's memory comes before the callbacks, and not a byte outside it is touched.
        std::vector<unsigned char> room(bytes + 192, 0xa5);
        const std::size_t start = 128 - reinterpret_cast<std::uintptr_t>(room.data()) % 64;
        def.memory = room.data() + start;
        def.memory_bytes = bytes;
        {
            Crowd in_place(def);
            CHECK(reinterpret_cast<void*>(in_place.get()) == def.memory);
            CHECK(ledger.taken == 2);
            for (std::uint32_t group = 0; group < 3; ++group) in_place.write_all(SWIVEL_TARGET, group, Float3{0, 1, 1});
            in_place.solve();
            const swivel_rows out = swivel_result_rows(in_place.get(), 2);
            const auto* end =
                reinterpret_cast<unsigned char*>(out.base + std::size_t{out.block_count} * out.row_count * 16);
            CHECK(end == room.data() + start + bytes);
        }
        CHECK(ledger.given_back == 1);
        for (std::size_t n = 0; n < room.size(); ++n)
            if (n < start || n >= start + bytes) REQUIRE(room[n] == 0xa5);

        def.memory_bytes = bytes - 1;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_OUT_OF_MEMORY);
        def.memory_bytes = bytes;
        def.memory = room.data() + start + 32;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
    }
}

TEST_CASE("nothing allocates after creation")
{
    // Every call once before counting: oneTBB starts its threads, the instruction set is chosen.
    const auto use = [](Crowd& crowd) {
        static std::vector<Float3> targets(5000, Float3{0, 1, 1});
        static std::vector<Float4> shoulders(5000);
        static std::vector<std::array<double, 3>> wrists(5000);
        static std::vector<double> residuals(5000);
        static const std::vector<std::uint32_t> mask(157, 0x80018001u);
        static const Streams own = [] {
            Streams made;
            made.in(SWIVEL_TARGET, {targets.data(), sizeof targets[0]});
            made.out(SWIVEL_SHOULDER, {shoulders.data(), sizeof shoulders[0]});
            return made;
        }();
        static const Job framed{
            .blocks = swivel_blocks{3, 200}, .mask = mask, .streams = {own}, .on_this_thread = true};
        crowd.write(SWIVEL_TARGET, 0, targets);
        crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
        crowd.solve({.blocks = swivel_blocks{0, 200}, .on_this_thread = true});
        crowd.solve(framed);
        crowd.read(SWIVEL_SHOULDER, 0, shoulders);
        crowd.wrists(0, wrists);
        crowd.residuals(0, residuals);
        (void)swivel_solve(nullptr, nullptr);
    };
    for (const swivel_features features : {swivel_features{0}, swivel_features{SWIVEL_WORLD | SWIVEL_WITH_HAND}}) {
        Crowd crowd = crowd_of(features, 5000);
        if (features & SWIVEL_WORLD) crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        use(crowd);
        const std::size_t before = allocation_count();
        for (int n = 0; n < 20; ++n) use(crowd);
        CHECK(allocation_count() == before);

        const std::vector<std::uint32_t> mask(157, 0x80018001u);
        const auto solve_in_every_way = [&] {
            crowd.solve();
            crowd.solve({.mask = mask});
        };
        const auto solve_alone = [&] {
#ifdef SWIVEL_WITH_TBB
            static oneapi::tbb::task_arena arena(1);
            arena.execute(solve_in_every_way);
#else
            solve_in_every_way();
#endif
        };
        for (int n = 0; n < 5; ++n) solve_alone();
        const std::size_t before_solve = allocation_count();
        for (int n = 0; n < 20; ++n) solve_alone();
        CHECK(allocation_count() == before_solve);
    }
    const std::size_t before = allocation_count();
    void* volatile by_new = ::operator new(1);  // a new expression may be left out
    void* volatile by_malloc = std::malloc(1);
    ::operator delete(by_new);
    std::free(by_malloc);
    CHECK(allocation_count() == before + 2);  // the counter counts
    const swivel_limb_def limb = group_of(100);
    const swivel_group_def group = c_group(limb);
    swivel_crowd_def def = def_of(group);
    swivel_crowd* crowd = nullptr;
    const std::size_t before_create = allocation_count();
    swivel_crowd_create(&def, &crowd);
    CHECK(allocation_count() == before_create + 1);
    swivel_crowd_destroy(crowd);
}
