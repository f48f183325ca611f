// SPDX-License-Identifier: MIT
#include "tools/corpus/recipe.h"

namespace swivel::corpus {

namespace {

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
    standing("feet", 0x2b8f6b1ddc2f4a93u, kHand | kEffector | kYields | kPoleIncoming | kCap | kFit | kComing, 0),
    standing("feet-by-motion", 0xe17c0e39a5b64d08u, kPoleIncoming | kByMotion | kCap | kFit, kFar | kSupports),
    standing("palms", 0x94d3a7f0167be25cu, kHand | kEffector | kPlantTurn | kPoleIncoming | kStep | kWeights,
             kTranslations | kSupports | kRests),
    standing("palms-by-motion", 0x5a02cf7be8913d64u, kHand | kPlantTurn | kByMotion | kPoleIncoming | kFit | kComing |
             kRecord | kFlexion | kClavicle, kBetween | kFar | kSupports | kAllJoints),
    standing("ground", 0xd10b5e3c96a2487fu, kHand | kEffector | kYields | kPoleIncoming | kCap | kFit | kGround,
             kSupports),
    standing("ground-by-motion", 0x3a9f04c7e85d216bu, kHand | kEffector | kPlantTurn | kByMotion | kPoleIncoming |
             kFit | kComing | kGround | kRecord, kTranslations | kFar | kSupports | kRests),
    standing("held-hand", 0x76e1d8b30c4fa295u, kHand | kEffector | kPoleIncoming | kGround | kHandFrame | kClavicle,
             kBetween | kFar | kSupports | kAllJoints, Holds::hand, kHand | kEffector | kPoleIncoming | kWeights |
             kLink | kHandFrame | kRecord | kClavicle),
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

std::span<const Recipe> body_recipes() { return kBodies; }
std::span<const Recipe> standing_recipes() { return kStanding; }

}  // namespace swivel::corpus
