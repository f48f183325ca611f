// SPDX-License-Identifier: MIT
//
// The report of a run whose figures go to standard output: a file that is tried before the work and written after it.
// Meanwhile there is no partial file, so a signal may end the run at once.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "tools/report/html.h"

namespace swivel::tools {

// A page or a report would replace a clip, a table or a crowd file of that name. Throws CommandError (bad usage).
void require_html_name(std::string_view option, const std::string& file);

// Throws CommandError for - and for a name of other files, and InputError for a file that cannot be written. file:
// empty for no report.
void require_report_file(const std::string& file);

// Makes the file appear. put: fills the report. Throws InputError as OutputFile does, and CommandError for a signal.
void write_report(const std::string& file, const std::string& title, const std::function<void(Report&)>& put);

}  // namespace swivel::tools
