// SPDX-License-Identifier: MIT
//
// The C interface: a crowd of any def, then calls in any order with any arguments. What must fail fails and changes
// nothing, what must succeed does and keeps the promises of the headers: each limb has
// the bits that it has alone, on every instruction set, whatever the job is. No byte beside the caller's values is
// touched.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "tests/fuzz/interface_session.h"

using namespace swivel::fuzz;

namespace {

constexpr std::uint32_t kMaxLimbs = 40;
constexpr int kMaxCalls = 40;
constexpr std::uint8_t kBodies = 0xb0;  // from this first byte on, the crowd is of bodies

struct Free {
    void operator()(char* memory) const { std::free(memory); }
};
using Arena = std::unique_ptr<char, Free>;

Arena aligned(std::size_t bytes) { return Arena(static_cast<char*>(std::aligned_alloc(64, bytes))); }

void call_fill(Session& session) { fill_inputs(session.bytes, *session.crowd); }  // normals of earlier solves stay

// Any instruction set that runs here.
void choose_isa(std::size_t any)
{
    std::vector<const char*> runnable;
    for (std::uint32_t n = 0; const char* const isa = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(isa)) runnable.push_back(isa);
    SWIVEL_REQUIRE(swivel_use_isa(runnable[any % runnable.size()]) == SWIVEL_OK);
}

void call_one(Session& session)
{
    constexpr std::array calls = {call_fill,    call_write,        call_write_doubles, call_read,
                                  call_solve,   call_solve,        call_solve,         call_solve,
                                  call_pack,    call_choose,       call_reset,         call_allowed_arcs,
                                  call_forward, call_joint_angles, call_residuals,     call_helper};
    session.arena_before.assign(session.arena.begin(), session.arena.end());
    calls[session.bytes.take<std::uint8_t>() % calls.size()](session);
}

// Calls in any order, with a crowd in memory of its own. must_be: the def is right.
void run(Session session, swivel_crowd_def def, bool must_be, std::size_t isa)
{
    const std::size_t needed = swivel_crowd_bytes(&def);
    SWIVEL_REQUIRE(needed > 0 || !must_be);
    const Arena arena = aligned(std::max<std::size_t>(needed, 64));
    def.memory = arena.get();
    def.memory_bytes = needed;
    session.group_count = def.group_count;
    session.arena = {arena.get(), needed};
    session.has_workspace = def.workspace_count > 0;
    const swivel_status status = swivel_crowd_create(&def, &session.crowd);
    SWIVEL_REQUIRE((status == SWIVEL_OK) == (needed > 0) && (session.crowd != nullptr) == (needed > 0));
    if (!session.crowd) return;
    session.is_solved = session.is_overwritten = session.limbs_that(false);
    session.alone.resize(def.group_count);
    choose_isa(isa);
    for (int n = 0; n < kMaxCalls && !session.bytes.is_empty(); ++n) call_one(session);
    session.alone.push_back(session.crowd);
    for (swivel_crowd* const crowd : session.alone) swivel_crowd_destroy(crowd);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    if (size > 0 && data[0] >= kBodies) {
        bytes.take<std::uint8_t>();
        BodyDef bodies(bytes, kMaxLimbs);
        swivel_crowd_def def = bodies.crowd_def(bodies.body_count);
        def.workspace_count = bytes.one_in(4) ? 0 : 1;
        run({.bytes = bytes, .bodies = &bodies}, def, bodies.is_sound, size);
        return 0;
    }
    swivel_crowd_def def = swivel_default_crowd_def();
    const std::vector<swivel_limb_def> limbs = limb_defs_of(bytes, kMaxLimbs);
    std::vector<swivel_group_def> groups(limbs.size(), swivel_default_group_def());
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g].limb = &limbs[g];
    def.groups = groups.data();
    def.group_count = static_cast<std::uint32_t>(groups.size());
    def.workspace_count = bytes.take<std::uint8_t>() % 4 == 3 ? 0 : 1;
    run({.bytes = bytes, .limb_defs = limbs}, def, true, size);
    return 0;
}
