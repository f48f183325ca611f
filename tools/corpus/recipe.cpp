// SPDX-License-Identifier: MIT
#include "tools/corpus/recipe.h"

#include <array>
#include <cstdint>
#include <iterator>

namespace swivel::corpus {

namespace {

// One kind of crowd, which the ordinary and the hard part both have.
struct PlainCrowd {
    const char* name;
    std::uint64_t ordinary_seed, hard_seed;
    std::uint64_t features;
};

// clang-format off
constexpr PlainCrowd kPlainCrowds[] = {
    {"arms", 0xd1a6e55e9b9b1325u, 0xa9dfdec6baecde5bu, 0},
    {"compact", 0x566bf9d7c55a45f8u, 0x699f071a5fd8e665u, kCompact},
    {"joints", 0xcf0c26ef4243ed52u, 0xf82d5644ef7d9967u, kJoints},
    {"joints-compact", 0x5d96cf7f265beda9u, 0xfdfb462fd6fad8dbu, kJoints | kCompact},
    {"hand", 0xc1d77cffb7decc0cu, 0xdb18bd763f20134cu, kHand},
    {"hand-compact", 0x5e6a0a2edd70e34du, 0x0e46c215b5fa5b0cu, kHand | kCompact},
    {"joints-hand", 0x0463513755ac0ecdu, 0xbf416c30f1f0742au, kJoints | kHand},
    {"joints-hand-compact", 0xb37523a53b4a3ee2u, 0x422acab59248b974u, kJoints | kHand | kCompact},
    {"world", 0x4de45321ad915a36u, 0x476354b65ed08d6bu, kWorld},
    {"world-compact", 0x9823beb1e6ba3ad7u, 0x3a7cfb366088155fu, kWorld | kCompact},
    {"world-joints", 0xdd4eabbd1fcfb980u, 0x37c990fad57dcafdu, kWorld | kJoints},
    {"world-joints-compact", 0x683447c10cc8af11u, 0x26ad41ef88c279d9u, kWorld | kJoints | kCompact},
    {"world-hand", 0xbfb637dd5bae2d26u, 0x6dbb8cb8ef65ed78u, kWorld | kHand},
    {"world-hand-compact", 0xaed09b824ca87fc2u, 0x0e0bc896afbec9a6u, kWorld | kHand | kCompact},
    {"world-joints-hand", 0x158d003d9a0b2361u, 0xdd63d2a5d1764460u, kWorld | kJoints | kHand},
    {"world-joints-hand-compact", 0x1ff135342e825ce1u, 0xda0aea0eaa72870bu, kWorld | kJoints | kHand | kCompact},
    {"world-direction", 0x33f5f28807f0cbd4u, 0x07bda21c604af42au, kWorld | kPoleDirection},
    {"world-direction-compact", 0x00d9f4ad53a2f2b6u, 0xd17737815438a5b5u, kWorld | kPoleDirection | kCompact},
    {"world-joints-direction", 0x4cc346363c234038u, 0xeee45145f585675fu, kWorld | kJoints | kPoleDirection},
    {"world-joints-direction-compact", 0xd330a5494d14cf1au, 0x84d0c3f0b2e73ae0u, kWorld | kJoints | kPoleDirection | kCompact},
    {"world-hand-direction", 0x668dc8f46a423cf9u, 0x5c80f9be67fd4c1eu, kWorld | kHand | kPoleDirection},
    {"world-hand-direction-compact", 0xd178403035c9a8c4u, 0xaa5bf36518677db7u, kWorld | kHand | kPoleDirection | kCompact},
    {"world-joints-hand-direction", 0x765890e0f94855d0u, 0xea394aba6a42ed19u, kWorld | kJoints | kHand | kPoleDirection},
    {"world-joints-hand-direction-compact", 0xaf5d8bb09f2e9ea4u, 0x70faf36fb78eda4fu, kWorld | kJoints | kHand | kPoleDirection | kCompact},
};
// clang-format on

constexpr auto plain_recipes_of(Part part)
{
    std::array<Recipe, std::size(kPlainCrowds)> recipes = {};
    for (std::size_t n = 0; n < recipes.size(); ++n) {
        const PlainCrowd& crowd = kPlainCrowds[n];
        const std::uint64_t seed = part == Part::ordinary ? crowd.ordinary_seed : crowd.hard_seed;
        recipes[n] = {part, crowd.name, seed, crowd.features};
    }
    return recipes;
}
constexpr auto kOrdinary = plain_recipes_of(Part::ordinary), kHard = plain_recipes_of(Part::hard);

constexpr Part limbs = Part::limbs;
// clang-format off
constexpr Recipe kLimbs[] = {
    {limbs, "effector", 0xca1ab21554c6c4b3u, kHand | kEffector},
    {limbs, "angle", 0x0f4bf777e1030fe1u, kAngle},
    {limbs, "pole-normal", 0x908a3e291dd257d5u, kPoleNormal},
    {limbs, "incoming", 0x2e0126319a72180du, kIncoming},
    {limbs, "incoming-hand", 0xfed5ce26af1ac6dau, kHand | kIncoming},
    {limbs, "pole-incoming", 0xcc31d7b90ff191f0u, kIncoming | kPoleIncoming},
    {limbs, "pole-hand", 0x6b1d90e7f3c2485au, kHand | kPoleHand},
    {limbs, "pole-hand-incoming", 0x84f2a6c50d3e197bu, kWorld | kJoints | kHand | kEffector | kIncoming | kPoleHand |
     kWeights | kStep, 0, Order::yxz, Order::zxy},
    {limbs, "weights", 0xf768f221a91b4e9du, kIncoming | kWeights},
    {limbs, "weights-hand", 0x4a66b263ab8474ccu, kHand | kIncoming | kWeights},
    {limbs, "reach", 0xc689c846b6b81ec6u, kReach},
    {limbs, "step", 0x535f2002b9f7f89eu, kStep},
    {limbs, "flexion", 0x355cca5db3c7b88eu, kFlexion},
    {limbs, "shoulder-cone", 0x857ce06bf9a21be1u, kShoulderCone},
    {limbs, "humeral-twist", 0x02c89680e98c5884u, kHumeralTwist},
    {limbs, "shoulder-box-xyz", 0xd6442260559d7e79u, kShoulderBox, 0, Order::xyz, Order::xyz},
    {limbs, "shoulder-box-xzy", 0x0473b8248ac03649u, kShoulderBox, 0, Order::xzy, Order::xyz},
    {limbs, "shoulder-box-yzx", 0x3cc89b41f339a684u, kShoulderBox, 0, Order::yzx, Order::xyz},
    {limbs, "shoulder-box-yxz", 0xd68c20053f91ed95u, kShoulderBox, 0, Order::yxz, Order::xyz},
    {limbs, "shoulder-box-zxy", 0x5f4e45815c00d3d2u, kShoulderBox, 0, Order::zxy, Order::xyz},
    {limbs, "shoulder-box-zyx", 0x86f4f14cc599fac7u, kShoulderBox, 0, Order::zyx, Order::xyz},
    {limbs, "region", 0x3c70d5a9e1f8264bu, kRegion},
    {limbs, "region-limits", 0x91e4b86d0a57cf32u, kWorld | kJoints | kHand | kEffector | kStep | kShoulderCone |
     kHumeralTwist | kShoulderBox | kForearmTwist | kWristBox | kRegion, 0, Order::yxz, Order::zxy},
    {limbs, "step-wins", 0xa6015f3c8d9e72b4u, kStep | kStepWins},
    {limbs, "step-wins-limits", 0x5ec9072ab1f3d846u, kHand | kAngle | kStep | kStepWins | kShoulderCone | kShoulderBox |
     kWristBox, 0, Order::yxz, Order::zxy},
    {limbs, "hand-cone", 0xd2e06b36b9ea43d4u, kHand | kHandCone},
    {limbs, "forearm-twist", 0xb2a57e606d09cf94u, kHand | kForearmTwist},
    {limbs, "hand-twist", 0x8d1eac030bab1534u, kHand | kHandTwist},
    {limbs, "wrist-box-xyz", 0x25609be3c444a62eu, kHand | kWristBox, 0, Order::xyz, Order::xyz},
    {limbs, "wrist-box-xzy", 0xed20eb98ea70df2du, kHand | kWristBox, 0, Order::xyz, Order::xzy},
    {limbs, "wrist-box-yzx", 0x133945bae4114d10u, kHand | kWristBox, 0, Order::xyz, Order::yzx},
    {limbs, "wrist-box-yxz", 0x40ba6f09be38fcbbu, kHand | kWristBox, 0, Order::xyz, Order::yxz},
    {limbs, "wrist-box-zxy", 0xd31f0231deef4351u, kHand | kWristBox, 0, Order::xyz, Order::zxy},
    {limbs, "wrist-box-zyx", 0xc8fd442ec56309d2u, kHand | kWristBox, 0, Order::xyz, Order::zyx},
    {limbs, "twist-bones-1", 0x0286ecec43432c6bu, kHand, 1},
    {limbs, "twist-bones-3", 0xbbb458d39fd583ebu, kHand, 3},
    {limbs, "twist-bones-7", 0x43e94334742de49bu, kHand, 7},
    {limbs, "twist-bones-3-joints", 0xf6bd8eca9f374cd6u, kJoints | kHand, 3},
    {limbs, "aim", 0x2293d03e9e6024cdu, kAim},
    {limbs, "aim-hand", 0x3d0d125a162d85c6u, kHand | kAim},
    {limbs, "clavicle", 0xf2e25394dbda118bu, kWorld | kClavicle},
    {limbs, "angle-world-direction", 0x59227301507a4f34u, kWorld | kPoleDirection | kAngle},
    {limbs, "compact-angle", 0x77a22873705bdd12u, kCompact | kAngle},
    {limbs, "compact-limits", 0x0c67a2cb603c1616u, kWorld | kJoints | kHand | kCompact | kAngle | kFlexion |
     kShoulderCone},
    {limbs, "set-incoming", 0x498e0b0d13f8bb73u, kIncoming, 0, Order::yxz, Order::zxy},
    {limbs, "set-world-joints-normal-angle-step", 0x2875a2d038ccde1eu, kWorld | kJoints | kPoleNormal | kAngle | kStep,
     0, Order::yxz, Order::zxy},
    {limbs, "set-joints-hand-incoming-pole-flexion-reach", 0xe6160abb7e3b9a59u, kJoints | kHand | kIncoming |
     kPoleIncoming | kReach | kFlexion, 0, Order::yxz, Order::zxy},
    {limbs, "set-shoulder-cone", 0x9d411e83fb7eca2fu, kShoulderCone, 0, Order::yxz, Order::zxy},
    {limbs, "set-shoulder-box", 0x6965c425b110d30au, kShoulderBox, 0, Order::yxz, Order::zxy},
    {limbs, "set-both-boxes", 0x2f2a44422f862cecu, kHand | kShoulderBox | kWristBox, 0, Order::yxz, Order::zxy},
    {limbs, "set-world-hand-twists", 0x9f61d62f48f8f164u, kWorld | kHand | kEffector | kHumeralTwist | kHandCone |
     kForearmTwist | kHandTwist, 0, Order::yxz, Order::zxy},
    {limbs, "set-all-limits", 0xbdef9f4b0ecb476fu, kWorld | kJoints | kHand | kPoleDirection | kEffector | kAngle |
     kIncoming | kWeights | kReach | kStep | kFlexion | kShoulderCone | kHumeralTwist | kShoulderBox | kHandCone |
     kForearmTwist | kHandTwist | kWristBox, 0, Order::yxz, Order::zxy},
    {limbs, "set-aim", 0xd2e83592e220532fu, kWorld | kJoints | kHand | kEffector | kStep | kShoulderCone | kAim, 0,
     Order::yxz, Order::zxy},
    {limbs, "set-clavicle", 0xe655f6aa8e18a60eu, kWorld | kJoints | kHand | kIncoming | kWeights | kClavicle, 0,
     Order::yxz, Order::zxy},
};
// clang-format on

constexpr Recipe body(const char* name, std::uint64_t seed, std::uint64_t features, std::uint32_t pose,
                      Form form = Form::rotations, std::uint32_t twist_bones = 0)
{
    return {Part::bodies, name, seed, features, twist_bones, Order::yxz, Order::zxy, form, pose};
}

// A row's skeleton, poses and goals come from its seed alone, so a further row changes no other row's digest.
// clang-format off
constexpr Recipe kBodies[] = {
    body("rotations", 0x6edd3a249018775au, 0, 0),
    body("rotations-places", 0x8687b18d8ce14c8bu, 0, kTranslations),
    body("rotations-scales", 0x1ed40c227dab7ad2u, 0, kScales),
    body("rotations-all", 0x3fe6e7be9ba05717u, kHand, kTranslations | kScales | kRoots | kBetween),
    body("rows", 0xcb674d999253f6b7u, kHand, kRoots | kBetween, Form::rows),
    body("columns", 0x2d38de7c3bec5519u, kHand, kRoots | kBetween, Form::columns),
    body("columns3", 0x57b39e4dbda513bdu, kHand, kRoots | kBetween, Form::columns3),
    body("far", 0xbafcaba920f0ac5cu, kHand, kTranslations | kRoots | kFar),
    body("far-pole-incoming", 0x06082c084826f652u, kPoleIncoming, kRoots | kFar, Form::columns),
    body("offsets-apart", 0xa93f99f2e8a4987eu, kHand, kBetween | kOffsets | kApart),
    body("rows-offsets-apart", 0xe2c532cf9756a036u, kHand, kRoots | kOffsets | kApart, Form::rows),
    body("rests", 0x70db71c4a6d5169eu, kHand, kTranslations | kScales | kRoots | kBetween | kRests),
    body("columns-rests", 0xb51d8b61ea81606du, kHand, kRoots | kBetween | kRests, Form::columns),
    body("lengths", 0x7f5364eb98d00ba6u, kHand, kScales | kRoots | kBetween | kLengths),
    body("pole-incoming", 0x0b0084f7de574f6du, kHand | kPoleIncoming, kTranslations | kRoots | kBetween),
    body("pole-normal-angle", 0x88b065e74dd5a9ecu, kPoleNormal | kAngle, kRoots),
    body("pole-direction", 0x373020538dcceab0u, kPoleDirection, kRoots, Form::rows),
    body("pole-hand", 0x29c7f04be81d6a35u, kHand | kPoleHand | kAngle | kClavicle, kTranslations | kRoots | kBetween |
         kFar),
    body("weights", 0x187e81ac2c112e79u, kWeights, kTranslations | kRoots),
    body("weights-hand-pole-incoming", 0x2d4cc06b3a1290fcu, kHand | kWeights | kPoleIncoming, kRoots | kBetween,
         Form::columns3),
    body("effector", 0x6acc5fa209ae3ad4u, kHand | kEffector, kScales | kRoots | kBetween),
    body("reach-step", 0x4285a3e8267133eeu, kHand | kReach | kStep, kTranslations | kScales | kRoots | kBetween),
    body("aim-step", 0x374cc47ee0d33d02u, kAim | kStep, kRoots, Form::columns),
    body("aim-hand", 0x4e9ac62aa1b018a7u, kHand | kEffector | kAim, kRoots | kBetween),
    body("set-both-boxes", 0x40eb60ed801cf357u, kHand | kPoleIncoming | kShoulderBox | kWristBox, kTranslations |
         kScales | kRoots | kBetween),
    body("set-all-limits", 0x1dba58587dc7abbeu, kHand | kEffector | kAngle | kWeights | kReach | kStep | kFlexion |
         kShoulderCone | kHumeralTwist | kShoulderBox | kHandCone | kForearmTwist | kHandTwist | kWristBox,
         kTranslations | kScales | kRoots | kBetween | kFar),
    body("twist-bones-1", 0xc620e2ee1e7f6dbfu, kHand, kRoots | kBetween, Form::rotations, 1),
    body("twist-bones-3", 0xd933b7e19cbfde6au, kHand | kWeights, kRoots, Form::columns, 3),
    body("twist-bones-7", 0xe438d972b37fdd13u, kHand | kPoleIncoming, kTranslations | kScales | kRoots | kBetween,
         Form::rotations, 7),
    body("clavicle", 0xada7368431d18069u, kClavicle, kTranslations | kScales | kRoots | kBetween),
    body("clavicle-hand", 0x5f55d09cb38f87c0u, kHand | kEffector | kWeights | kClavicle, kRoots | kBetween | kRests,
         Form::rows),
    body("clavicle-aim", 0x9c14d0fba73440e0u, kHand | kAim | kClavicle, kRoots),
    body("in-body", 0xf74369b51ad50868u, kHand, kTranslations | kScales | kBetween | kInBody),
    body("in-body-apart", 0xa60f9adc38b516ecu, kHand, kTranslations | kScales | kRoots | kBetween | kOffsets | kApart
         | kInBody),
    body("in-body-rows", 0x1a2696745873b1c6u, kHand | kClavicle, kRoots | kBetween | kInBody, Form::rows, 2),
    body("in-body-columns", 0x0fc311120b86a2a7u, kPoleIncoming, kRoots | kFar | kInBody, Form::columns),
    body("in-body-columns3", 0x1a67d17e11a44ab6u, kWeights, kRoots | kApart | kInBody, Form::columns3),
    body("all-joints", 0x54e0185bac60bb88u, kHand, kTranslations | kScales | kRoots | kBetween | kAllJoints,
         Form::rotations, 3),
    body("in-body-all-joints", 0xd5664a18991e0412u, kHand | kClavicle, kRoots | kBetween | kInBody | kAllJoints,
         Form::columns),
    body("region", 0x7d2ec1950bf8a463u, kHand | kHandCone | kRegion, kTranslations | kRoots | kInBody),
    body("record", 0x6360defb29d0059du, kHand | kReach | kStep | kRecord, kTranslations | kScales | kRoots |
         kBetween),
    body("record-aim-clavicle", 0xa4ce2b48d1cfb335u, kAim | kClavicle | kRecord, kRoots),
    body("set-everything", 0x4320a72c42d80ff4u, kHand | kEffector | kAngle | kWeights | kReach | kStep | kFlexion |
         kShoulderCone | kHumeralTwist | kShoulderBox | kHandCone | kForearmTwist | kHandTwist | kWristBox | kClavicle
         | kRecord, kTranslations | kScales | kRoots | kBetween | kFar | kInBody | kAllJoints, Form::rotations, 3),
};
constexpr Recipe standing(const char* name, std::uint64_t seed, std::uint64_t features, std::uint32_t pose,
                          Holds holds = Holds::nothing, std::uint64_t holding = 0)
{
    return {Part::standing, name, seed, kPlant | features, 0, Order::zyx, Order::xzy, Form::rotations, kRoots | pose,
            holds, holding};
}
constexpr Recipe kStanding[] = {
    standing("feet", 0x2b8f6b1ddc2f4a93u, kHand | kEffector | kYields | kPoleIncoming | kCap | kFit | kNextTarget, 0),
    standing("feet-by-motion", 0xe17c0e39a5b64d08u, kPoleIncoming | kByMotion | kCap | kFit, kFar | kSupports),
    standing("palms", 0x94d3a7f0167be25cu, kHand | kEffector | kPlantRotation | kPoleIncoming | kStep | kWeights,
             kTranslations | kSupports | kRests),
    standing("palms-by-motion", 0x5a02cf7be8913d64u, kHand | kPlantRotation | kByMotion | kPoleIncoming | kFit | kNextTarget |
             kRecord | kFlexion | kClavicle, kBetween | kFar | kSupports | kAllJoints),
    standing("ground", 0xd10b5e3c96a2487fu, kHand | kEffector | kYields | kPoleIncoming | kCap | kFit | kGround,
             kSupports),
    standing("ground-by-motion", 0x3a9f04c7e85d216bu, kHand | kEffector | kPlantRotation | kByMotion | kPoleIncoming |
             kFit | kNextTarget | kGround | kRecord, kTranslations | kFar | kSupports | kRests),
    standing("held-hand", 0x76e1d8b30c4fa295u, kHand | kEffector | kPoleIncoming | kGround | kHandTransform | kClavicle,
             kBetween | kFar | kSupports | kAllJoints, Holds::hand, kHand | kEffector | kPoleIncoming | kWeights |
             kLink | kHandTransform | kRecord | kClavicle),
    standing("prop", 0x0f52c96ae7b8d341u, kHand | kPoleIncoming | kFit, kTranslations, Holds::prop, kHand | kEffector |
             kPoleIncoming | kCap | kLink | kRecord),
    standing("looks", 0x4bd27e9360fa815cu, kHand | kPoleIncoming | kFit, kTranslations | kSupports | kLooks),
    standing("looks-far", 0xe6351fa80cb97d24u, kHand | kEffector | kPoleIncoming | kClavicle, kBetween | kFar | kSupports |
             kAllJoints | kRests | kLooks),
    standing("looks-in-body", 0x187f0ae54d9b36c2u, kHand | kPoleIncoming | kFit, kTranslations | kInBody | kLooks,
             Holds::prop, kHand | kEffector | kPoleIncoming | kLink),
    standing("prop-at-joint", 0xb9837d1f5ec0264au, kHand | kEffector | kPoleIncoming | kGround | kFit, kBetween | kFar |
             kSupports | kRests, Holds::prop_at_joint, kHand | kEffector | kYields | kPoleIncoming | kReach |
             kStep | kLink),
};
// clang-format on

}  // namespace

std::span<const Recipe> ordinary_recipes() { return kOrdinary; }
std::span<const Recipe> hard_recipes() { return kHard; }
std::span<const Recipe> limb_recipes() { return kLimbs; }
std::span<const Recipe> body_recipes() { return kBodies; }
std::span<const Recipe> standing_recipes() { return kStanding; }

}  // namespace swivel::corpus
