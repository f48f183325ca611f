// SPDX-License-Identifier: MIT
//
// The C interface: a crowd of any def, then calls in any order with any arguments. What must fail fails and changes
// nothing, what must succeed does and keeps the promises of swivel.h: each limb has
// the bits that it has alone, on every instruction set, whatever the job is. No byte beside the caller's values is
// touched.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "tests/fuzz/crowd_of_bytes.h"
#include "tests/fuzz/interface_session.h"
#include "tests/fuzz/require.h"

using namespace swivel::fuzz;

namespace {

constexpr std::uint32_t kMostLimbs = 40;
constexpr int kMostCalls = 40;

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    swivel_crowd_def def = swivel_default_crowd_def();
    std::vector<swivel_group_def> groups = groups_of(bytes, kMostLimbs);
    def.groups = groups.data();
    def.group_count = static_cast<std::uint32_t>(groups.size());
    def.workspace_count = bytes.take<std::uint8_t>() % 4 == 3 ? 0 : 1;

    const std::size_t needed = swivel_crowd_bytes(&def);
    SWIVEL_REQUIRE(needed > 0);
    const Arena arena = aligned(needed);
    def.memory = arena.get();
    def.memory_bytes = needed;
    Session session{bytes, nullptr, def.group_count, {arena.get(), needed}};
    session.has_workspace = def.workspace_count > 0;
    SWIVEL_REQUIRE(swivel_crowd_create(&def, &session.crowd) == SWIVEL_OK);
    session.is_solved.resize(session.lane_count());
    session.groups = groups;
    session.alone.resize(groups.size());
    choose_isa(size);
    for (int n = 0; n < kMostCalls && !bytes.is_empty(); ++n) call_one(session);
    session.alone.push_back(session.crowd);
    for (swivel_crowd* const crowd : session.alone) swivel_crowd_destroy(crowd);
    return 0;
}
