// SPDX-License-Identifier: MIT
//
// What a call costs: solves of 1, 16, 64 and 256 arms, in nanoseconds a call. calls/here/ is a job on the calling
// thread, calls/job/ the default job, calls/hand/ the bare kernel by hand on the same blocks, calls/frame/ a job on the
// calling thread that copies from and to the caller's structures. Here less hand is the fixed overhead.
#include "bench/rivals/probe.h"
#include "bench/rivals/whole_frame.h"
#include "bench/suite.h"

namespace bench {

namespace {

void add_call(const std::string& name, std::size_t arm_count, const std::string& isa, const Work& work)
{
    const auto prepare = [isa, work] {
        swivel::check(swivel_use_isa(isa.c_str()));
        return work;
    };
    add(name + isa + "/" + std::to_string(arm_count), 1, Clock::cpu, prepare,
        {{"arms/call", static_cast<double>(arm_count)}});
}

}  // namespace

void add_calls(Suite& suite)
{
    for (const std::size_t arm_count : {1u, 16u, 64u, 256u}) {
        const auto crowd = std::make_shared<swivel::Crowd>(make_crowd(0, arm_count, random_limbs(arm_count)));
        const swivel_rows in = swivel_input_rows(crowd->get(), 0), out = swivel_result_rows(crowd->get(), 0);
        for (const std::string& isa : suite.isas) {
            if (isa == "scalar" && suite.isas.size() > 1) continue;
            swivel_job here = swivel_default_job();
            here.on_this_thread = 1;
            add_call("calls/here/", arm_count, isa,
                     [crowd, here] { swivel::check(swivel_solve(crowd->get(), &here)); });
            add_call("calls/hand/", arm_count, isa, [crowd, in, out, by_hand = probe_of(isa.c_str()).solve_by_hand] {
                by_hand(in.base, out.base, in.block_count);
            });
        }
        add_call("calls/job/", arm_count, suite.best_isa(),
                 [crowd] { swivel::check(swivel_solve(crowd->get(), nullptr)); });
        if (arm_count < 2 * kArms) continue;  // frames are of whole characters
        const auto frame = std::make_shared<WholeFrame>(arm_count / kArms);
        add_call("calls/frame/", arm_count, suite.best_isa(), [frame] { frame->framed().solve_in_one(); });
    }
}

}  // namespace bench
