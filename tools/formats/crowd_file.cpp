// SPDX-License-Identifier: MIT
#include "tools/formats/crowd_file.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "tools/formats/error.h"
#include "tools/formats/limits.h"

namespace swivel::formats {
namespace {

constexpr std::array<std::string_view, 9> kSelectors = {"all",      "arms",      "legs",     "left",     "right",
                                                        "left_arm", "right_arm", "left_leg", "right_leg"};
constexpr std::array<std::string_view, 6> kPoleKinds = {"point",    "direction", "normal",
                                                        "incoming", "hand",      "half_line"};
constexpr std::array<std::string_view, 6> kOrders = {"XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX"};
constexpr std::array<std::string_view, 3> kLimbKinds = {"arms", "legs", "all"};
constexpr NumberRange kFree = {-180, 180};

bool speaks_of_both_sides(std::string_view selector)
{
    return selector == "all" || selector == "arms" || selector == "legs";
}

// A value converted to another type.
template <class To, class From, class Make>
Maybe<To> converted(const Maybe<From>& from, Make make)
{
    if (!from) return std::nullopt;
    return Given<To>{make(from->value), from->line, from->key};
}

// A value that is a table of its own, read whole.
template <class T>
Maybe<T> given_by(const TomlTable& table, T value)
{
    if (!table.is_there()) return std::nullopt;
    return Given<T>{value, table.line(), table.key()};
}

Maybe<NumberRange> angles(TomlTable& table, std::string_view key) { return table.range(key, -360, 360, 360); }

// The value of a required key. Call it when all keys of the table are read.
template <class T>
T needed(const TomlTable& table, std::string_view key, const Maybe<T>& value)
{
    if (table.is_there() && !value) table.fail("", std::string(key) + " is missing");
    return value ? value->value : T{};
}

const Eigen::Vector3d kAlong = {0, 0, 1};  // along the resting limb

Maybe<ConeLimit> read_cone(TomlTable table, double min = 0, double max = 180)
{
    const auto axis = table.axis("axis");
    const auto opening_deg = table.number("opening_deg", min, max);
    table.finish();
    return given_by(table, ConeLimit{axis ? axis->value : kAlong, needed(table, "opening_deg", opening_deg)});
}

Maybe<TwistLimit> read_twist(TomlTable table)
{
    const auto axis = table.axis("axis");
    const auto range_deg = angles(table, "range_deg");
    table.finish();
    return given_by(table, TwistLimit{axis ? axis->value : kAlong, needed(table, "range_deg", range_deg)});
}

Maybe<AimGoal> read_aim(TomlTable table)
{
    const auto axis = table.axis("axis");
    const auto flexion_deg = table.number("flexion_deg", 0, 180);
    table.finish();
    return given_by(table, AimGoal{needed(table, "axis", axis), needed(table, "flexion_deg", flexion_deg)});
}

Maybe<BoxLimit> read_box(TomlTable table)
{
    BoxLimit box;
    if (const auto order = table.word("order", kOrders)) box.order = static_cast<EulerOrder>(order->value);
    bool any = false;
    for (std::size_t n = 0; n < 3; ++n) {
        const auto about = angles(table, std::array{"x_deg", "y_deg", "z_deg"}[n]);
        box.about_deg[n] = about ? about->value : kFree;
        any = any || about;
    }
    table.finish();
    if (table.is_there() && !any) table.fail("", "limits nothing; give x_deg, y_deg or z_deg, or leave the table out");
    return given_by(table, box);
}

// Cones of a region are neither a point nor all directions.
std::vector<ConeLimit> read_cones(const std::vector<TomlTable>& tables)
{
    std::vector<ConeLimit> cones;
    for (const TomlTable& table : tables) cones.push_back(read_cone(table, 0.6, 179.4)->value);
    return cones;
}

Maybe<RegionLimit> read_region(TomlTable table)
{
    RegionLimit region;
    region.cones = read_cones(table.tables("cones"));
    region.forbidden = read_cones(table.tables("forbidden"));
    for (TomlTable polygon : table.tables("polygons")) {
        const auto corners = polygon.vectors("corners");
        polygon.finish();
        region.polygons.push_back(needed(polygon, "corners", corners));
    }
    if (const auto closed = table.flag("closed")) region.closed = closed->value;
    const auto margin = table.number("clip_margin_deg", 1, 57);
    const auto count = table.whole("clip_cones", 1, 6);
    table.finish();
    if (region.closed && region.cones.size() < 3) table.fail("closed", "means nothing with fewer than three cones");
    if (count && !margin)
        table.fail("clip_cones", "means nothing without clip_margin_deg; give that, or take this out");
    if (margin) region.clip_margin_deg = margin->value;
    if (count) region.clip_cones = static_cast<int>(count->value);
    if (table.is_there() && region.cones.empty() && region.polygons.empty() && !margin)
        table.fail(
            "",
            "allows nothing; give cones, polygons or clip_margin_deg, or leave the table out. It adds nothing to the "
            "region of a more general table, but takes its place");
    return given_by(table, std::move(region));
}

void read_pole(TomlTable table, LimbSettings& settings)
{
    settings.pole_kind =
        converted<PoleKind>(table.word("kind", kPoleKinds), [](std::size_t n) { return static_cast<PoleKind>(n); });
    settings.pole_fixed = table.vector("fixed");
    settings.pole_angle_deg = table.number("angle_deg", -360, 360);
    table.finish();
}

void read_weights(TomlTable table, LimbSettings& settings)
{
    constexpr std::array keys{"position", "hand", "pole"};
    for (std::size_t n = 0; n < keys.size(); ++n) settings.weights[n] = table.number(keys[n], 0, 1);
    table.finish();
}

void read_reach(TomlTable table, LimbSettings& settings)
{
    for (std::size_t n = 0; n < kReachKeys.size(); ++n) {
        const bool is_stretch = kReachKeys[n] == "max_stretch";
        settings.reach[n] = table.number(kReachKeys[n], is_stretch ? 1 : 0, is_stretch ? 1000 : 1);
    }
    table.finish();
}

void read_swivel(TomlTable table, LimbSettings& settings)
{
    settings.step_deg_per_frame = table.number("max_deg_per_frame", 0, 180);
    settings.step_deg_per_second = table.number("max_deg_per_second", 0, 1e6);
    if (settings.step_deg_per_frame && settings.step_deg_per_second)
        table.fail("max_deg_per_second", "max_deg_per_frame is given, too; keep one of them");
    settings.step_wins = table.flag("step_wins");
    table.finish();
}

Maybe<Limit> read_limit(TomlTable& limits, std::string_view key)
{
    const auto as_limit = [](const auto& given) {
        return converted<Limit>(given, [](const auto& value) { return Limit(value); });
    };
    if (key.ends_with("_cone")) return as_limit(read_cone(limits.table(key)));
    if (key.ends_with("_box")) return as_limit(read_box(limits.table(key)));
    // A key without a unit has a table, which is no cone and no box: a twist about an axis.
    if (!key.ends_with("_deg")) return as_limit(read_twist(limits.table(key)));
    return as_limit(key == "flexion_deg" ? limits.range(key, 0, 180, 180) : angles(limits, key));
}

void read_limits(TomlTable table, LimbSettings& settings)
{
    for (std::size_t n = 0; n < kLimitKeys.size(); ++n) settings.limits[n] = read_limit(table, kLimitKeys[n]);
    settings.region = read_region(table.table("region"));
    table.finish();
}

LimbSettings read_limb(TomlTable table, bool is_one)
{
    LimbSettings settings;
    if (is_one) {  // others speak of several limbs, which do not share joints, and do not all hold one hand
        settings.joints = table.texts("joints", 3);
        settings.bend = table.axis("bend");
        settings.hold = converted<LimbName>(table.word("hold", std::span(kSelectors).last(kLimbNames.size())),
                                            [](std::size_t n) { return kLimbNames[n]; });
    }
    for (const char* const key : {"joints", "bend", "hold"})
        if (!is_one && table.has(key))
            table.fail(key, "is of one limb; write it in that one's table, such as [limb.left_arm]");
    TomlTable target = table.table("target");
    settings.target_point = target.vector("point");
    settings.target_offset = target.vector("offset");
    target.finish();
    settings.hand = table.flag("hand");
    settings.effector = table.vector("effector");
    settings.aim = read_aim(table.table("aim"));
    TomlTable clavicle = table.table("clavicle");
    settings.clavicle_share = clavicle.number("share", 0, 1);
    clavicle.finish();
    read_pole(table.table("pole"), settings);
    read_weights(table.table("weights"), settings);
    read_reach(table.table("reach"), settings);
    read_swivel(table.table("swivel"), settings);
    read_limits(table.table("limits"), settings);
    settings.twist_bones = table.whole("twist_bones", 0, kMaxTwistBones);
    table.finish();
    return settings;
}

// "auto", [first, last] or false.
Maybe<LoopFrames> read_loop(TomlTable& table)
{
    constexpr std::string_view kKey = "loop", kAuto[] = {"auto"};
    if (table.is_flag(kKey)) {
        if (table.flag(kKey)->value) table.fail(kKey, "is true; write \"auto\", [first, last] or false");
        return std::nullopt;
    }
    if (!table.is_list(kKey))
        return converted<LoopFrames>(table.word(kKey, kAuto), [](std::size_t) { return LoopFrames(); });
    return converted<LoopFrames>(table.range(kKey, 0, UINT32_MAX, UINT32_MAX), [&](const NumberRange& frames) {
        const std::array ends{static_cast<std::size_t>(frames.min), static_cast<std::size_t>(frames.max)};
        if (static_cast<double>(ends[0]) != frames.min || static_cast<double>(ends[1]) != frames.max)
            table.fail(kKey, "frames are counted; write whole numbers");
        return LoopFrames(ends);
    });
}

std::vector<FurtherClip> read_clips(TomlTable& table)
{
    std::vector<FurtherClip> clips;
    for (TomlTable& each : table.tables("clips")) {
        const Maybe<std::string> file = each.text("file"), animation = each.text("clip");
        each.finish();
        if (!file && !animation) each.fail("", "names no motion; write { file = \"FILE\" } or { clip = \"NAME\" }");
        clips.push_back({each.line(), each.key(), file ? file->value : "", animation ? animation->value : ""});
    }
    return clips;
}

void read_crowd(TomlTable table, CrowdFile& file)
{
    file.characters = table.whole("characters", 1, 10'000'000);
    file.seed = table.whole("seed", 0, INT64_MAX);
    file.spacing = table.number("spacing", 0, 1e6);
    file.size = table.range("size", 0.01, 100, 100);
    file.legs = table.range("legs", 0.2, 5, 5);
    file.arms = table.range("arms", 0.2, 5, 5);
    file.spine = table.range("spine", 0.2, 5, 5);
    file.speed = table.range("speed", 0.2, 5, 5);
    file.heading_deg = table.range("heading_deg", -180, 180, 360);
    file.stagger = table.flag("stagger");
    file.agents = table.text("agents");
    file.loop = read_loop(table);
    file.clips = read_clips(table);
    file.limbs = converted<std::string>(table.word("limbs", kLimbKinds),
                                        [](std::size_t n) { return std::string(kLimbKinds[n]); });
    file.targets = table.text("targets");
    table.finish();
    for (const char* const key : {"characters", "spacing", "size", "heading_deg", "stagger"})
        if (file.agents && table.has(key))
            table.fail(key, "is of a crowd without a table, and agents names one; keep one of them");
}

void read_ground(TomlTable table, CrowdFile& file)
{
    GroundSettings ground{table.line(), table.text("heights"), table.vector("size"), table.vector("middle"),
                          table.text("contacts")};
    table.finish();
    if (ground.heights && !ground.size) table.fail("size", "is missing; write how large the picture is: [x, y, z]");
    if (ground.size && !ground.heights) table.fail("size", "is of a picture; name it by heights, or take this out");
    if (ground.size && !(ground.size->value.array() > 0).all()) table.fail("size", "is not above 0; write [x, y, z]");
    if (table.is_there()) file.ground = std::move(ground);
}

void read_look(TomlTable table, CrowdFile& file)
{
    const Maybe<Eigen::Vector3d> target = table.vector("target");
    const Maybe<double> max_deg = table.number("max_deg", 0, 180);
    Maybe<std::string> head = table.text("head");
    table.finish();
    if (!table.is_there()) return;
    if (!target) table.fail("target", "is missing; write what heads look at: [x, y, z]");
    file.look = {table.line(), target->value, max_deg ? max_deg->value : LookSettings().max_deg, std::move(head)};
}

void read_carry(TomlTable table, CrowdFile& file)
{
    const Maybe<double> share = table.number("share", 0, 1);
    CarrySettings carry{table.line(), share ? share->value : CarrySettings().share, table.vector("size"),
                        table.vector("place")};
    table.finish();
    if (carry.size && !(carry.size->value.array() > 0).all()) table.fail("size", "is not above 0; write [x, y, z]");
    if (table.is_there()) file.carry = std::move(carry);
}

void read_root(TomlTable root, CrowdFile& file)
{
    read_crowd(root.table("crowd"), file);
    read_ground(root.table("ground"), file);
    read_look(root.table("look"), file);
    read_carry(root.table("carry"), file);
    TomlTable budget = root.table("budget");
    file.budget_blocks = budget.whole("blocks", 1, UINT32_MAX);
    budget.finish();
    TomlTable limbs = root.table("limb");
    for (const std::string_view selector : kSelectors) {
        const TomlTable limb = limbs.table(selector);
        LimbSettings settings = read_limb(limb, limb_of_word(selector).has_value());
        if (limb.is_there()) file.sections.push_back({std::string(selector), limb.line(), std::move(settings)});
    }
    limbs.finish();
    root.finish();
}

void merge(LimbSettings& to, const LimbSettings& from, bool mirrored)
{
    using S = LimbSettings;
    if (from.step_deg_per_frame || from.step_deg_per_second)  // both limit the same step
        to.step_deg_per_frame.reset(), to.step_deg_per_second.reset();
    const auto take = [mirrored](auto& into, const auto& given) {
        if (!given) return;
        into = given;
        into->mirrored = mirrored;
    };
    const auto take_each = [&](auto... member) { (take(to.*member, from.*member), ...); };
    const auto take_all = [&](auto& into, const auto& given) {
        for (std::size_t n = 0; n < given.size(); ++n) take(into[n], given[n]);
    };
    take_each(&S::joints, &S::bend, &S::hold, &S::target_point, &S::target_offset, &S::hand, &S::effector, &S::aim,
              &S::clavicle_share, &S::pole_kind, &S::pole_fixed, &S::pole_angle_deg, &S::step_deg_per_frame,
              &S::step_deg_per_second, &S::step_wins, &S::region, &S::twist_bones);
    take_all(to.weights, from.weights);
    take_all(to.reach, from.reach);
    take_all(to.limits, from.limits);
}

}  // namespace

CrowdFile read_crowd_file(const std::filesystem::path& path)
{
    const toml::table root = read_toml(path);
    CrowdFile file;
    file.path = path;
    read_root(TomlTable(path, root), file);
    return file;
}

bool selects(std::string_view selector, LimbName limb)
{
    return selector == "all" || selector == limb_word(limb) || selector == side_name(limb.side) ||
           selector == (limb.kind == LimbKind::arm ? "arms" : "legs");
}

LimbSettings settings_of(const CrowdFile& file, LimbName limb)
{
    LimbSettings settings;
    for (const LimbSection& section : file.sections)
        if (selects(section.selector, limb))
            merge(settings, section.settings, limb.side == Side::right && speaks_of_both_sides(section.selector));
    return settings;
}

}  // namespace swivel::formats
