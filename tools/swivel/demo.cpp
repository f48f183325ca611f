// SPDX-License-Identifier: MIT
//
// `swivel demo`: the main job on made-up input. A crowd of characters stands on a square, each hand draws a loop in
// front of its shoulder, at its own pace and reach, some of it out of reach; every frame all arms are solved.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

// One arm: metres, y up, the character facing +z before it is turned.
struct DemoArm {
    float target[3], pole[3], lengths[2], position[3], rotation[4];
    float pace, phase, reach;  // of its loop: turns a frame, turns, size
};

float unit(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

// The shoulder of character n, on the side +1 or -1, turned about the vertical.
DemoArm make_limb(std::uint32_t n, float side, std::uint32_t columns, std::mt19937& random)
{
    DemoArm limb{};
    const float size = 0.9f + 0.2f * unit(random), turn = 6.2831853f * unit(random);
    const float x = 2.0f * static_cast<float>(n % columns), z = 2.0f * static_cast<float>(n / columns);
    limb.lengths[0] = 0.30f * size;
    limb.lengths[1] = 0.26f * size;
    limb.rotation[1] = std::sin(turn / 2);
    limb.rotation[3] = std::cos(turn / 2);
    limb.position[0] = x + side * 0.2f * size * std::cos(turn);
    limb.position[1] = 1.45f * size;
    limb.position[2] = z - side * 0.2f * size * std::sin(turn);
    limb.pace = 0.004f + 0.01f * unit(random);
    limb.phase = unit(random);
    limb.reach = (limb.lengths[0] + limb.lengths[1]) * (0.45f + 0.65f * unit(random));
    return limb;
}

// Where the hand and the elbow should be in a frame: a figure of eight in front of the shoulder, the elbow low and
// outwards.
void move(DemoArm& limb, float side, std::uint32_t frame)
{
    const float t = 6.2831853f * (limb.phase + limb.pace * static_cast<float>(frame));
    const float local[3] = {side * 0.4f * limb.reach * std::sin(t), 0.4f * limb.reach * std::sin(2 * t),
                            0.8f * limb.reach};
    const float pole[3] = {side * 0.5f, -1.0f, -0.2f};
    const float s = 2 * limb.rotation[1] * limb.rotation[3], c = 1 - 2 * limb.rotation[1] * limb.rotation[1];
    const auto place = [&](const float(&v)[3], float(&to)[3]) {
        to[0] = limb.position[0] + c * v[0] + s * v[2];
        to[1] = limb.position[1] + v[1];
        to[2] = limb.position[2] - s * v[0] + c * v[2];
    };
    place(local, limb.target);
    place(pole, limb.pole);
}

class DemoCrowd {
public:
    explicit DemoCrowd(const DemoOptions& options)
        : limbs_{std::vector<DemoArm>(options.characters), std::vector<DemoArm>(options.characters)},
          residuals_(options.characters),
          flags_(options.characters),
          crowd_(SWIVEL_WORLD, groups(options.characters))
    {
        const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(options.characters)));
        std::mt19937 random(static_cast<std::uint32_t>(options.seed ^ options.seed >> 32));
        for (std::uint32_t group = 0; group < 2; ++group) {
            std::vector<DemoArm>& limbs = limbs_[group];
            for (std::uint32_t n = 0; n < limbs.size(); ++n) limbs[n] = make_limb(n, side(group), columns, random);
            write(SWIVEL_LENGTHS, group, limbs[0].lengths);
            write(SWIVEL_SHOULDER_POSITION, group, limbs[0].position);
            write(SWIVEL_PARENT_ROTATION, group, limbs[0].rotation);
        }
    }

    void solve_frame(std::uint32_t frame, Statistics& statistics)
    {
        for (std::uint32_t group = 0; group < 2; ++group) {
            std::vector<DemoArm>& limbs = limbs_[group];
            for_ranges(static_cast<std::uint32_t>(limbs.size()), [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t n = begin; n < end; ++n) move(limbs[n], side(group), frame);
            });
            write(SWIVEL_TARGET, group, limbs[0].target);
            write(SWIVEL_POLE, group, limbs[0].pole);
        }
        const auto before = std::chrono::steady_clock::now();
        crowd_.solve({.on_this_thread = is_one_thread()});
        statistics.solve_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    }

    void measure(std::uint32_t frame, Statistics& statistics)
    {
        for (std::uint32_t group = 0; group < 2; ++group) {
            crowd_.residuals(group, residuals_);
            crowd_.read(SWIVEL_FLAGS, group, flags_);
            for (std::uint32_t n = 0; n < flags_.size(); ++n) {
                const PoseName pose{frame, n, formats::kLimbNames[group]};
                statistics.arms.add_flags(flags_[n], residuals_[n], pose);
                (flags_[n] & SWIVEL_REACHED ? statistics.arms.reached : statistics.arms.missed)
                    .add(residuals_[n], pose);
            }
        }
    }

private:
    static float side(std::uint32_t group) { return group == 0 ? 1.0f : -1.0f; }
    static std::vector<swivel_group_def> groups(std::uint32_t characters) { return {2, group(characters)}; }
    void write(swivel_field field, std::uint32_t group, const float* first)
    {
        check(swivel_write(crowd_.get(), field, group, 0, static_cast<std::uint32_t>(limbs_[group].size()),
                           {first, sizeof(DemoArm)}));
    }

    std::vector<DemoArm> limbs_[2];  // left, right
    std::vector<double> residuals_;
    std::vector<std::uint32_t> flags_;
    Crowd crowd_;
};

}  // namespace

void run_demo(const DemoOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const ThreadLimit limit(options.threads);
    DemoCrowd crowd(options);
    Statistics statistics;
    {
        Progress progress("frames", options.frames, options.quiet);
        for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
            progress.show(frame);
            crowd.solve_frame(frame, statistics);
            crowd.measure(frame, statistics);
        }
    }
    if (options.json) {
        nlohmann::ordered_json out{
            {"characters", options.characters}, {"frames", options.frames}, {"seed", options.seed}};
        out.update(json_of(statistics));
        print_json(out);
        return;
    }
    say(stdout, "demo     {} characters, {} arms, {} frames of made-up reaching\n", options.characters,
        2 * options.characters, options.frames);
    print_statistics(stdout, statistics);
}

}  // namespace swivel::tools
