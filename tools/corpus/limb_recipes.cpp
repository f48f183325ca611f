// SPDX-License-Identifier: MIT
#include "tools/corpus/recipe.h"

namespace swivel::corpus {

namespace {

using enum Part;

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

}  // namespace

std::span<const Recipe> limb_recipes() { return kLimbs; }

}  // namespace swivel::corpus
