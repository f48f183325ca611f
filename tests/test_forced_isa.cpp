// SPDX-License-Identifier: MIT
//
// A process of its own for each value of SWIVEL_FORCE_ISA, which the library reads once. What must be seen:
//   refused  the name cannot be used: solving fails with a status and a line that repeats it, until swivel_use_isa()
//   used     the name is the one in use; a CPU without it must refuse it
//   best     the value is empty: the first that runs is in use
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "swivel/swivel.h"

namespace {

int failures = 0;

void check(bool held, const char* what)
{
    if (held) return;
    std::fprintf(stderr, "failed: %s (last error: '%s')\n", what, swivel_last_error());
    ++failures;
}

swivel_crowd* one_arm()
{
    const swivel_limb_def limb = swivel_default_limb_def(1);
    swivel_group_def group = swivel_default_group_def();
    group.limb = &limb;
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 1;
    def.groups = &group;
    swivel_crowd* crowd = nullptr;
    check(swivel_crowd_create(&def, &crowd) == SWIVEL_OK, "a crowd can be made without an instruction set");
    return crowd;
}

void check_refused(const std::string& forced)
{
    swivel_crowd* const crowd = one_arm();
    const swivel_rows rows = swivel_result_rows(crowd, 0);
    const std::vector<float> before(rows.base, rows.base + rows.row_count * SWIVEL_LANES);
    const auto says_so = [&] {
        return std::string(swivel_last_error()).find("SWIVEL_FORCE_ISA=" + forced + " ") != std::string::npos;
    };
    check(swivel_isa_name() == nullptr, "swivel_isa_name() is null");
    check(says_so(), "swivel_isa_name() leaves a line with the name");
    swivel_solve(nullptr, nullptr);  // another line
    bool built = false;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n) built = built || forced == name;
    const swivel_blocks first{0, 1};
    swivel_job job = swivel_default_job();
    for (const bool on_this_thread : {false, true}) {
        swivel_solve(nullptr, nullptr);
        if (on_this_thread) job.blocks = &first, job.on_this_thread = 1;
        check(swivel_solve(crowd, &job) == (built ? SWIVEL_ISA_UNAVAILABLE : SWIVEL_UNKNOWN_ISA), "a job says why");
        check(says_so(), "a job leaves a line with the name");
    }
    check(std::memcmp(before.data(), rows.base, before.size() * sizeof(float)) == 0, "failed solves write nothing");
    check(swivel_use_isa("scalar") == SWIVEL_OK, "a name from the program helps");
    check(swivel_solve(crowd, nullptr) == SWIVEL_OK, "then solving works");
    check(swivel_isa_name() && std::string(swivel_isa_name()) == "scalar", "with that instruction set");
    swivel_crowd_destroy(crowd);
}

void check_used(const std::string& name)
{
    swivel_crowd* const crowd = one_arm();
    check(swivel_solve(crowd, nullptr) == SWIVEL_OK, "swivel_solve works");
    check(swivel_isa_name() && swivel_isa_name() == name, "the expected one is in use");
    swivel_crowd_destroy(crowd);
}

std::string best()
{
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(name)) return name;
    return "";
}

}  // namespace

int main(int argument_count, char** arguments)
{
    const char* const forced = std::getenv("SWIVEL_FORCE_ISA");
    const std::string expected = argument_count == 2 ? arguments[1] : "", name = forced ? forced : "";
    if (expected == "refused")
        check_refused(name);
    else if (expected == "best")
        check_used(best());
    else if (expected == "used" && swivel_isa_runs(name.c_str()))
        check_used(name);
    else if (expected == "used") {
        std::printf("this CPU does not run %s: it must be refused\n", name.c_str());
        check_refused(name);
    } else
        check(false, "usage: test_forced_isa refused|used|best");
    return failures != 0;
}
