// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "core/language/analysis.h"
#include "core/language/formatter.h"

namespace carom {

CommandRow formatCommand();

namespace {

int runFormat(const Arguments& arguments) {
    const std::string& path = arguments.operands.front();
    const bool inPlace = arguments.has("in-place");
    if (inPlace && path == "-") throw UsageError("`--in-place` needs a file; standard input has no place");
    const Analysis analysis = analyse(readText(path));
    const std::string formatted = formatText(analysis);
    if (!inPlace)
        printOut(formatted);
    else if (formatted != analysis.text)
        replaceFile(path, formatted);
    return exitcode::done;
}

} // namespace

CommandRow formatCommand() {
    return {
        .name = "format",
        .summary = "Write a scene in the canonical layout",
        .operands = "SCENE",
        .example = "carom format scenes/tour.sdl\ncarom format --in-place scenes/tour.sdl",
        .options = {{"in-place", 'i', "", "replace the file, at once or not at all"}},
        .details =
            "Only white space changes: every word, number and comment stays, and formatting twice changes "
            "nothing more. What cannot be read is left as it stands.",
        .leastOperands = 1,
        .mostOperands = 1,
        .run = runFormat};
}

} // namespace carom
