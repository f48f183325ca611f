// SPDX-License-Identifier: MIT
//
// The promise: a binding that is none, and a limb that cannot be bound, are refused in one line, which names what is
// wrong. Nothing is made, and nothing changes. Each row is a good definition with one thing changed.
#include "tests/refused_definitions.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("results as joints need bindings of unit rotations and of their twist bones, or of bones that are said later")
{
    swivel_limb_def limb = limbs(3, SWIVEL_JOINTS);
    const swivel_group_def group = c_group(limb);
    const swivel_crowd_def def = def_of(group);
    check_refused(&def, "group 0 has no binding; make it with swivel_bind_joints()");
    limb = group_of(3), limb.features = SWIVEL_JOINTS | SWIVEL_WITH_HAND;
    CHECK(swivel_crowd_bytes(&def) > 0);
    swivel_binding& b = limb.binding;
    for (float* const q :
         {b.parent_from_arm, b.upper_from_arm, b.elbow_parent_from_arm, b.fore_from_arm, b.wrist_parent_from_arm,
          b.shoulder_rest, b.elbow_rest, b.wrist_rest, b.twist_parent_from_arm[6], b.twist_from_arm[0]}) {
        for (const float w : {0.0f, 1.001f, kNan}) {
            q[3] = w;
            check_refused(&def, w == 0 && q == b.parent_from_arm ? "has no binding" : "unit");
            CHECK_NOTHROW(crowd_with(0, {limb}));
        }
        q[3] = 1;
    }
    for (const Float2& lengths : {Float2{kNan, kNan}, Float2{0, 1}, Float2{1, 0}, Float2{0, 0}}) {
        std::ranges::copy(lengths, b.lengths);
        if (lengths == Float2{0, 0})
            check_refused(&def, "group 0's binding has bones of length 0");
        else
            CHECK(swivel_crowd_bytes(&def) > 0);
    }
    b = group_of(3).binding;
    for (const std::uint32_t bound : {0u, 2u})  // 0: then twist bones need not be bound
        for (std::uint32_t bones = 0; bones <= 7; ++bones) {
            b.twist_bone_count = bound, limb.twist_bone_count = bones;
            if (bound == 0 || bones == 0 || bones == bound)
                CHECK(swivel_crowd_bytes(&def) > 0);
            else
                check_refused(&def,
                              ("group 0's binding has 2 twist bones, the group " + std::to_string(bones)).c_str());
        }
}

namespace {

// Joints 0 root, 1 shoulder, 2 between, 3 elbow, 4 between, 5 and 6 twist bones, 7 wrist, 8 a finger, 9 another root.
struct Figure {
    std::vector<std::int32_t> parents = {-1, 0, 1, 2, 3, 4, 4, 4, 7, -1};
    std::vector<Float4> rotations = std::vector<Float4>(10, Float4{0, 0, 0, 1});
    std::vector<Float3> translations = {{0, 0, 0}, {0, 1, 0},    {0.1f, 0, 0}, {0.2f, 0, 0}, {0.1f, 0, 0},
                                        {0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0}};
    std::vector<std::uint32_t> twist_bones = {5, 6};
    swivel_skeleton skeleton = view_of(*this);
    swivel_limb_joints joints = swivel_default_limb_joints(1, 3, 7);

    Figure()
    {
        joints.twist_bones = twist_bones.data();
        joints.twist_bone_count = 2;
        joints.bend[2] = 1;
    }
    swivel_status bind(swivel_binding* binding) const { return swivel_bind_joints(&skeleton, &joints, binding); }
};
// A limb with nothing aligned.
struct SkewedLimb {
    Random random{9};
    ThreeJoints rest = skewed_joints(random);

    swivel_status bind(swivel_binding* binding) const
    {
        const swivel_skeleton skeleton = rest.skeleton();
        const swivel_limb_joints joints = rest.joints();
        return swivel_bind_joints(&skeleton, &joints, binding);
    }
};

// Binds, and then once more as it was changed.
template <class Good, class Change>
void check_unbound(const std::string& words, const Change& change)
{
    INFO("should say: " << words);
    Good good;
    swivel_binding binding = swivel_default_binding();
    REQUIRE(good.bind(&binding) == SWIVEL_OK);
    const swivel_binding before = binding;
    change(good);
    CHECK_REFUSED(good.bind(&binding), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(), Catch::Contains(words));
    CHECK(std::memcmp(&binding, &before, sizeof binding) == 0);
}

}  // namespace

TEST_CASE("swivel_bind_joints refuses joints that do not exist or are no limb, by name, and rest poses that are none")
{
    const Refusal<Figure> refusals[] = {
        {"the elbow is joint 10, but the skeleton has 10 joints", [](auto& f) { f.joints.elbow = 10; }},
        {"twist bone 1 is joint 4294967295, but", [](auto& f) { f.twist_bones[1] = ~0u; }},
        {"the shoulder is joint 1, but the skeleton has 0 joints", [](auto& f) { f.skeleton.joint_count = 0; }},
        {"joint 2's parent is 99; give -1 for a root", [](auto& f) { f.parents[2] = 99; }},
        {"joint 0's parent is -2; give -1 for a root", [](auto& f) { f.parents[0] = -2; }},
        {"the parents of the shoulder, joint 1, go round in a circle", [](auto& f) { f.parents[0] = 4; }},
        {"the elbow, joint 9, is not below the shoulder, joint 1", [](auto& f) { f.joints.elbow = 9; }},
        {"the elbow, joint 1, is not below the shoulder, joint 1", [](auto& f) { f.joints.elbow = 1; }},
        {"the wrist, joint 3, is not below the elbow, joint 7",
         [](auto& f) { f.joints.elbow = 7, f.joints.wrist = 3; }},
        {"twist bone 0, joint 2, is not below the elbow, joint 3", [](auto& f) { f.twist_bones[0] = 2; }},
        {"twist bone 1, joint 8, hangs below the wrist, joint 7, and would turn with it",
         [](auto& f) { f.twist_bones[1] = 8; }},
        {"the wrist, joint 7, hangs below twist bone 0, joint 4, and would turn with it",
         [](auto& f) { f.twist_bones[0] = 4; }},
        {"twist bone 1, joint 6, hangs below twist bone 0, joint 5", [](auto& f) { f.parents[6] = 5; }},
        {"twist bone 0 and twist bone 1 are both joint 6", [](auto& f) { f.twist_bones[0] = 6; }},
        {"the wrist and twist bone 1 are both joint 7", [](auto& f) { f.twist_bones[1] = 7; }},
        {"twist bone 1, joint 5, is nearer to the elbow than twist bone 0, joint 6; list them from elbow to wrist",
         [](auto& f) { std::swap(f.twist_bones[0], f.twist_bones[1]); }},
        {"there are 8 twist bones; a limb has at most 7", [](auto& f) { f.joints.twist_bone_count = 8; }},
        {"twist_bones is null", [](auto& f) { f.joints.twist_bones = nullptr; }},
        {"the upper arm has no direction",
         [](auto& f) {
             f.translations[2] = f.translations[3] = {0, 0, 0};
         }},
        {"straight within 10 degrees, so it does not show where the limb bends to; give the bend",
         [](auto& f) { f.joints.bend[2] = 0; }},
        {"the bend lies along the upper arm", [](auto& f) { f.joints.bend[0] = 1e6f; }},
        {"the skeleton's parents are null", [](auto& f) { f.skeleton.parents = {}; }},
        {"the skeleton's translations are null", [](auto& f) { f.skeleton.translations = {}; }},
        {"parents have stride 2, which is smaller than a value, 4 bytes",
         [](auto& f) { f.skeleton.parents.stride = 2; }},
        {"translations have stride 0", [](auto& f) { f.skeleton.translations.stride = 0; }},
        {"rotations have stride 12", [](auto& f) { f.skeleton.rotations.stride = 12; }},
        {"skeleton has size 0", [](auto& f) { f.skeleton.size = 0; }},
        {"limb joints has size 4096", [](auto& f) { f.joints.size = 4096; }},
        {"build with the header", [](auto& f) { f.joints.size += 8; }},
        {"reserved is not 0", [](auto& f) { f.joints.reserved = 1; }},
        {"reserved is not 0", [](auto& f) { f.skeleton.reserved = 1; }},
    };
    for (const auto& [words, change] : refusals) check_unbound<Figure>(words, change);
    for (const std::uint32_t joint : {1u, 2u, 3u, 4u, 5u, 7u})
        for (const float bad : {0.0f, kNan, kInf, 3e38f})
            check_unbound<Figure>("joint " + std::to_string(joint) + "'s rest rotation is zero or not finite",
                                  [&](Figure& f) { f.rotations[joint].fill(bad); });
    for (const std::uint32_t joint : {2u, 3u, 4u, 6u, 7u})
        for (const float bad : {kNan, kInf, 3e38f})
            check_unbound<Figure>("joint " + std::to_string(joint) + "'s translation is not finite",
                                  [&](Figure& f) { f.translations[joint][1] = bad; });
}

TEST_CASE("swivel_bind_joints refuses bones and bends that are no limb's, whatever is aligned")
{
    for (const float bad : {0.0f, 1e-20f}) {
        check_unbound<SkewedLimb>("joint 1's rest rotation", [&](auto& s) { s.rest.rotations[1].fill(bad); });
        check_unbound<SkewedLimb>("forearm has no direction", [&](auto& s) { s.rest.translations[2].fill(bad); });
    }
    const Refusal<SkewedLimb> refusals[] = {
        {"the bend is not finite", [](auto& s) { s.rest.bend[1] = kInf; }},
        {"the bend is not finite or longer than 1e15", [](auto& s) { s.rest.bend[1] = 3e38f; }},
        {"the bend lies along the upper arm", [](auto& s) { s.rest.bend = s.rest.translations[1]; }},
        {"the forearm at rest lies along the axis",
         [](auto& s) {
             const Vector3d hinge = vec(s.rest.bend).cross(vec(s.rest.translations[1]));
             const Quaterniond elbow = quat(s.rest.rotations[1]).normalized();
             s.rest.translations[2] = floats(Vector3d(elbow.conjugate() * hinge));
         }},
    };
    for (const auto& [words, change] : refusals) check_unbound<SkewedLimb>(words, change);
}
