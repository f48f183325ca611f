// SPDX-License-Identifier: MIT
#include "tools/corpus/looking.h"

#include <span>

#include "tools/corpus/hard_cases.h"
#include "tools/corpus/hard_poses.h"

namespace swivel::corpus {

Looking::Looking(const Recipe& recipe, const std::vector<Body>& bodies, Poses& poses)
{
    const std::size_t body_count = bodies.size();
    poses.has_looks = true;
    for (std::uint32_t k = 0; k < kLookCount; ++k) {
        recipe.pose& kFar ? poses.far_look_targets[k].resize(3 * body_count) : rows_[k].targets.resize(3 * body_count);
        rows_[k].weights.resize(body_count);
    }
    for (std::uint32_t n = 0; n < body_count; ++n) {
        Looker looker{stream(recipe.seed, 2, Field::motion, Use::value, n), bodies[n].root_scale, {}};
        for (auto& places : looker.places)
            for (Vector& place : places) {
                const double size = looker.random.spread(-2, 4);
                place = size * random_direction(looker.random);
            }
        lookers_.push_back(looker);
    }
}

void Looking::move_body(std::uint32_t n, const Vector& root, double swing, Poses& poses)
{
    Looker& looker = lookers_[n];
    for (std::uint32_t k = 0; k < kLookCount; ++k) {
        const std::uint32_t kind = looker.random.below(64);
        const double size = (kind == 0 ? 1e6 : 1) * looker.scale;
        const bool is_none = kind == 1 || n % 16 == 15;
        const auto& [from, to] = looker.places[k];
        const Vector none{kNan, kNan, kNan}, place = is_none ? none : root + size * between(from, to, swing);
        if (poses.far_look_targets[k].empty())
            put_vector(place, &rows_[k].targets[3 * n]);
        else
            put_vector(place, &poses.far_look_targets[k][3 * n]);
        const double weights[] = {1, 1, swing, 0};
        rows_[k].weights[n] = static_cast<float>(weights[n / 2 % 4]);
    }
    if (looker.random.below(64) == 0) spoil_body(n, poses);
}

void Looking::spoil_body(std::uint32_t n, Poses& poses)
{
    Random& random = lookers_[n].random;
    const std::uint32_t k = random.below(kLookCount);
    if (random.below(2) == 0)
        spoil(random, std::span(rows_[k].weights).subspan(n, 1), 1);
    else if (poses.far_look_targets[k].empty())
        spoil(random, std::span(rows_[k].targets).subspan(3 * n, 3), 2);
    else
        spoil(random, std::span(poses.far_look_targets[k]).subspan(3 * n, 3), 2);
}

void Looking::write(Crowd& crowd) const { write_looks(crowd, rows_); }

}  // namespace swivel::corpus
