// SPDX-License-Identifier: MIT
#include "bench/rivals/production_limb.h"

namespace bench {

FramedCrowd production_crowd(std::vector<ProductionLimb>& limbs)
{
    swivel::Crowd crowd = make_crowd(kProduction, limbs.size(), random_limbs(limbs.size()));
    ProductionLimb& first = limbs[0];
    swivel::Streams frame;
    const auto in = [&](swivel_field field, float* values) {
        swivel::check(swivel_read(crowd.get(), field, 0, 0, static_cast<std::uint32_t>(limbs.size()),
                                  {values, sizeof(ProductionLimb)}));
        frame.in(field, swivel_in{values, sizeof(ProductionLimb)});
    };
    const auto out = [&](swivel_field field, void* values) {
        frame.out(field, swivel_out{values, sizeof(ProductionLimb)});
    };
    in(SWIVEL_TARGET, first.target);
    in(SWIVEL_POLE, first.pole);
    in(SWIVEL_LENGTHS, first.lengths);
    in(SWIVEL_SHOULDER_POSITION, first.parent.position);
    in(SWIVEL_PARENT_ROTATION, first.parent.rotation);
    in(SWIVEL_PARENT_SCALE, first.parent.scale);
    in(SWIVEL_HAND, first.hand);
    in(SWIVEL_INCOMING_SHOULDER, first.incoming[0]);
    in(SWIVEL_INCOMING_ELBOW, first.incoming[1]);
    in(SWIVEL_INCOMING_WRIST, first.incoming[2]);
    in(SWIVEL_WEIGHTS, first.weights);
    in(SWIVEL_REACH, first.reach);
    in(SWIVEL_FLEXION_LIMIT, first.flexion);
    in(SWIVEL_SHOULDER_CONE, first.cone);
    out(SWIVEL_SHOULDER, first.solved[0]);
    out(SWIVEL_ELBOW, first.solved[1]);
    out(SWIVEL_WRIST, first.solved[2]);
    out(SWIVEL_STRETCH, &first.stretch);
    out(SWIVEL_FLAGS, &first.flags);
    return {std::move(crowd), {std::move(frame)}};
}

}  // namespace bench
