// SPDX-License-Identifier: MIT
#include "tools/cli/command_error.h"

#include <array>
#include <new>
#include <system_error>

#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/formats/partial.h"
#include "tools/formats/printable.h"

namespace swivel::tools {

namespace {

std::array<char, 200> noted_advice;
std::size_t noted_advice_size = 0;

// One line on its way to standard error: in one write where it fits, so that those of several processes do not mix.
// Takes no memory.
class LineBuffer {
public:
    // As a terminal may have it, on one line.
    void add(std::string_view text) noexcept
    {
        formats::EscapeRoom room;
        while (!text.empty()) {
            const bool is_end = text[0] == '\n';
            const std::string_view next = is_end ? " " : formats::take_printable(text, room);
            if (is_end) text.remove_prefix(1);
            put(next);
        }
    }
    void end() noexcept
    {
        put("\n");
        say_text(stderr, {bytes_.data(), size_});
    }

private:
    void put(std::string_view bytes) noexcept
    {
        if (size_ + bytes.size() > bytes_.size()) {
            say_text(stderr, {bytes_.data(), size_});
            size_ = 0;
        }
        size_ += bytes.copy(bytes_.data() + size_, bytes.size());
    }

    std::array<char, 8192> bytes_;
    std::size_t size_ = 0;
};

// To be called where an exception is caught: says it.
int tell()
{
    if (const int signal = noted_stop_signal())  // whatever else it has brought about
        return fail(exit_code_of_signal(signal), kInterrupted);
    try {
        throw;
    } catch (const CommandError& error) {
        return fail(error.exit_code, error.what());
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::broken_pipe) return exit_code_of_signal(SIGPIPE);
        if (error.code() == std::errc::not_enough_memory) return fail(1, kNotEnoughMemory, memory_advice());
        return fail(1, error.what());
    } catch (const std::bad_alloc&) {
        return fail(1, kNotEnoughMemory, memory_advice());
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

// To be called where nothing was thrown. A signal may have come too late to throw.
int tell_of_end()
{
    const bool is_whole = is_output_whole();
    if (const int signal = noted_stop_signal()) return fail(exit_code_of_signal(signal), kInterrupted);
    if (!formats::Partial::unremoved().empty()) return fail(1, "an unfinished file stays");
    if (is_whole) return 0;
    if (has_lost_its_reader()) return exit_code_of_signal(SIGPIPE);
    return fail(1, "standard output could not be written in full");
}

}  // namespace

void note_memory_advice(std::string_view advice) noexcept
{
    noted_advice_size = advice.copy(noted_advice.data(), noted_advice.size());
}

std::string_view memory_advice() noexcept { return {noted_advice.data(), noted_advice_size}; }

int fail(int code, std::string_view line, std::string_view advice) noexcept
{
    LineBuffer text;
    text.add("swivel: ");
    text.add(line);
    text.add(advice);
    if (const std::string_view rest = formats::Partial::unremoved(); !rest.empty()) {
        text.add("; ");
        text.add(rest);
        text.add("; remove it");
    }
    text.end();
    return code;
}

int run_to_end(const std::function<void()>& work) noexcept
{
    const WriteSignals become_errors;
    forget_stop_signal();
    try {
        work();
    } catch (...) {
        std::fflush(stdout);  // what was said before comes first
        const int code = tell();
        is_output_whole();
        return code;
    }
    return tell_of_end();
}

}  // namespace swivel::tools
