// SPDX-License-Identifier: MIT
//
// A second process that does the same work at the same time. It shares nothing with this one but the machine: what two
// threads of one process can be held against.
#pragma once

#include "bench/suite.h"

namespace bench {

class Twin {
public:
    // Each process calls prepare and keeps what it returns, so that its memory is its own.
    explicit Twin(const std::function<Work()>& prepare);
    ~Twin();
    Twin(const Twin&) = delete;
    Twin& operator=(const Twin&) = delete;

    // Both do their work. Returns when the last one has done it.
    void run();

private:
    void end() const;

    int line_ = -1;  // to the other process: a byte to it starts its work, a byte from it says that it is ready
    int process_ = -1;
    Work work_;
};

}  // namespace bench
