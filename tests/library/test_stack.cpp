// SPDX-License-Identifier: MIT
//
// The promise: no call of an optimised library takes more than 32 KiB of stack, so jobs fit fibres of 64 KiB. Each call
// runs on a thread whose stack was painted, with every instruction set of this CPU. What is no longer painted was used.
#include <pthread.h>
#include <sys/mman.h>

#include <cstring>
#include <functional>

#include "swivel/lecture.h"
#include "swivel/swivel_explain.h"
#include "tests/body_crowd.h"
#include "tests/test_crowd.h"
#include "tests/test_scopes.h"
#include "tools/corpus/corpus.h"

using namespace swivel;
using namespace swivel::test;
using corpus::full_name;
using corpus::Part;
using corpus::Recipe;

namespace {

constexpr std::size_t kPromised = 32 * 1024;
constexpr unsigned char kPaint = 0xa5;

struct Painted {
    const std::function<void()>& call;
    unsigned char* lowest;
    std::size_t used = 0;
};

// Paints the stack below this function's frame, calls, and looks how far down the paint is gone.
[[gnu::noinline]] void measure(Painted& painted)
{
    unsigned char* const frame = static_cast<unsigned char*>(__builtin_frame_address(0));
    constexpr std::size_t kOwnFrame = 512;  // of this function and of memset; it counts as used
    std::memset(painted.lowest, kPaint, static_cast<std::size_t>(frame - painted.lowest) - kOwnFrame);
    painted.call();
    const unsigned char* deepest = painted.lowest;
    while (*deepest == kPaint) ++deepest;
    painted.used = static_cast<std::size_t>(frame - deepest);
}

// Runs a call on a thread with that much stack, and returns how many bytes of it were used. All threads have the same
// memory.
constexpr std::size_t kMaxStack = 192 * 1024;
std::size_t stack_of(const std::function<void()>& call, std::size_t size = kMaxStack)
{
    static void* const memory =
        mmap(nullptr, kMaxStack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    Painted painted{call, static_cast<unsigned char*>(memory)};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, memory, size);
    pthread_t thread;
    const auto start = [](void* given) -> void* {
        measure(*static_cast<Painted*>(given));
        return nullptr;
    };
    REQUIRE(pthread_create(&thread, &attributes, start, &painted) == 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    return painted.used;
}

// The most that any call took, and which one it was.
struct Most {
    std::size_t bytes = 0;
    std::string what;

    void take(const std::string& name, const std::function<void()>& call)
    {
        const std::size_t used = stack_of(call);
        if (used > bytes) bytes = used, what = name;
    }
};

// Frames that take every result of each group out of the crowd, as far as frames can.
struct Frames {
    std::vector<Streams> own;
    std::vector<swivel_streams> frames;
    std::vector<std::vector<float>> values;

    explicit Frames(const Crowd& crowd)
    {
        constexpr std::size_t kFloats = 4 * 7, kResults = SWIVEL_RESULT_END - SWIVEL_SHOULDER;  // seven twist bones
        for (std::uint32_t g = 0; swivel_group_limb_count(crowd.get(), g) > 0; ++g) {
            std::vector<float>& group =
                values.emplace_back(kFloats * kResults * swivel_group_limb_count(crowd.get(), g));
            Streams& frame = own.emplace_back();
            for (std::size_t n = 0; SWIVEL_SHOULDER + n < SWIVEL_RESULT_END; ++n)
                if (const auto field = static_cast<swivel_field>(SWIVEL_SHOULDER + n);
                    swivel_field_row_count(crowd.get(), g, field) > 0)
                    frame.out(field, {group.data() + kFloats * n, kFloats * kResults * sizeof(float)});
        }
        frames.assign(own.begin(), own.end());
    }
};

// Every kind of job over a crowd, on rows and on frames. pose: of bodies.
void run_jobs(Crowd& crowd, const swivel_pose* pose, const std::string& name, Most& max)
{
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    const std::vector<std::uint32_t> few((blocks + 1) / 2, 0x00018001u), many((blocks + 1) / 2, 0xfff70ff7u);
    std::vector<std::pair<const char*, swivel_job>> jobs;
    const auto add = [&](const char* kind) -> swivel_job& {
        return jobs.emplace_back(kind, swivel_default_job()).second;
    };
    add("whole");
    add("on this thread").on_this_thread = 1;
    add("few limbs of a mask").mask = few.data();
    add("many limbs of a mask").mask = many.data();
    Frames frames(crowd);
    for (auto& [kind, job] : jobs) {
        if (job.mask) job.mask_word_count = (blocks + 1) / 2, job.on_this_thread = 1;
        job.pose = pose;
        const auto solve = [&, &each = job] { check(swivel_solve(crowd.get(), &each)); };
        max.take(name + ", " + kind, solve);
        job.streams = frames.frames.data();
        max.take(name + ", " + kind + ", with frames", solve);
    }
}

// Calls that judge a crowd's results, of limbs of each group. pose: of bodies, of which the first limb is compared with
// one that is nowhere, so that every mistake is tried.
void run_questions(const Crowd& crowd, const swivel_pose* pose, const std::string& name, Most& max)
{
    constexpr double shoulder[3] = {0.3, 1.2, 0.1}, elbow[3] = {0.5, 1, 0.3}, wrist[3] = {0.7, 1.1, 0.5};
    char text[4096];
    swivel_arc arcs[200];
    std::vector<swivel_shape> shapes(4096);
    std::uint32_t count;
    double three[3], seven[7];
    const swivel_crowd* const c = crowd.get();
    std::vector<std::byte> state(swivel_state_bytes(c));
    max.take(name + ", save", [&] { swivel_save(c, 0, 1, state.data(), state.size()); });
    max.take(name + ", load", [&] { swivel_load(crowd.get(), 0, 1, state.data(), state.size()); });
    if (pose)
        max.take(name + ", compare",
                 [&] { swivel_compare(c, 0, 0, pose, shoulder, elbow, wrist, text, sizeof text, nullptr); });
    for (std::uint32_t g = 0; g < swivel_group_count(c); ++g)
        for (std::uint32_t limb = 0; limb < swivel_group_limb_count(c, g); limb += 7) {
            max.take(name + ", explain", [&] { swivel_explain(c, g, limb, text, sizeof text); });
            max.take(name + ", draw", [&] { swivel_draw(c, g, limb, pose, shapes.data(), 4096, &count); });
            max.take(name + ", allowed arcs", [&] { swivel_allowed_arcs(c, g, limb, arcs, std::size(arcs), &count); });
            max.take(name + ", residuals", [&] { swivel_residuals(c, g, limb, 1, {three, sizeof three}); });
            max.take(name + ", forward", [&] {
                swivel_forward(c, g, limb, 1, {three, sizeof three}, {three, sizeof three}, {nullptr, 0});
            });
            max.take(name + ", joint angles", [&] {
                swivel_joint_angles(c, g, limb, 1, SWIVEL_XYZ, SWIVEL_ZYX, 0, {seven, sizeof seven});
            });
        }
}

}  // namespace

TEST_CASE("every kind of job, on every kind of crowd, takes at most 32 KiB of stack")
{
    const IsaScope scope;
    for (const std::string& isa : runnable_isas()) {
        swivel_use_isa(isa.c_str());
        Most jobs, questions;
        for (const Part part : corpus::kParts)
            for (const Recipe& recipe : corpus::recipes_of(part)) {
                Crowd crowd = corpus::make_crowd(recipe, 100);
                corpus::Poses poses = corpus::poses_of(crowd, recipe, 0);
                corpus::with_job(poses, [&](const Job& job) {
                    run_jobs(crowd, job.pose, full_name(recipe), jobs);
                    run_questions(crowd, job.pose, full_name(recipe), questions);
                });
            }
        INFO(isa << ": " << jobs.what << ": " << jobs.bytes << "; " << questions.what << ": " << questions.bytes);
        CHECK(jobs.bytes <= kPromised);
        CHECK(questions.bytes <= kPromised);
    }
}

TEST_CASE("jobs run on threads of 64 KiB, also on oneTBB's own")
{
    const IsaScope scope;
    std::uint64_t alone = 0, together = 0;
    Crowd crowd = corpus::make_crowd(corpus::recipe_of(Part::limbs, "set-both-boxes"), 3000);
    for (const std::string& isa : runnable_isas()) {
        swivel_use_isa(isa.c_str());
        const auto solve_twice = [&] {
            swivel_solve(crowd.get(), nullptr);
            together = crowd.digest();
            swivel_job job = swivel_default_job();
            job.on_this_thread = 1;
            swivel_solve(crowd.get(), &job);
            alone = crowd.digest();
        };
        stack_of(solve_twice, 64 * 1024);
        CHECK(alone == together);
    }
}

TEST_CASE("the other calls take at most 32 KiB of stack")
{
    Most max;
    Random random{7};
    const BodySkeleton rest = random_body_skeleton(random, {300, 1, 3, true, 7});
    double axis[3], closing;
    float value[12];
    swivel_binding binding = swivel_default_binding();
    max.take("bind joints", [&] {
        const swivel_skeleton skeleton = rest.view();
        const swivel_limb_joints joints = rest.joints(0);
        swivel_bind_joints(&skeleton, &joints, &binding);
    });
    const float up[4] = {0, 0, 0, 1};
    const double ahead[3] = {0, -1, 1}, target[3] = {0.5, 0.9, 0.7}, pole[3] = {0, -1, 0};
    max.take("arm axis", [&] { swivel_arm_axis(&binding, up, ahead, axis); });
    max.take("cone", [&] { swivel_cone(ahead, 1, value); });
    max.take("steps", [&] {
        swivel_entity entities[SWIVEL_ENTITY_COUNT];
        swivel_steps(target, pole, 1, 0.75, entities, &closing);
    });
    max.take("verify", [&] {
        swivel_verify(
            100, 7, [](const swivel_check*, void*) {}, nullptr);
    });
    swivel_limb_def limb_defs[] = {group_of(40), group_of(7)};
    for (swivel_limb_def& limb : limb_defs) limb.features = kEverything;
    const swivel_group_def groups[] = {c_group(limb_defs[0]), c_group(limb_defs[1])};
    swivel_crowd_def def = def_of(groups[0]);
    def.group_count = 2;
    swivel_crowd* crowd = nullptr;
    max.take("create", [&] { swivel_crowd_create(&def, &crowd); });
    REQUIRE(crowd);
    std::vector<float> many(40 * 12);
    std::uint32_t mask[2];
    float urgency[4] = {};
    const swivel_in priorities[] = {{many.data(), 0}, {many.data(), 0}};
    for (const swivel_field field : every_field()) {
        max.take("write", [&] { swivel_write(crowd, field, 0, 0, 40, {many.data(), 48}); });
        max.take("read", [&] { swivel_read(crowd, field, 0, 0, 40, {many.data(), 48}); });
    }
    max.take("choose", [&] { swivel_choose(crowd, priorities, urgency, 1, mask, 2, nullptr); });
    max.take("digest", [&] { swivel_digest(crowd); });
    max.take("destroy", [&] { swivel_crowd_destroy(crowd); });
    INFO(max.what << ": " << max.bytes);
    CHECK(max.bytes <= kPromised);
}
