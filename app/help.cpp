// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/version.h"

#include <string>

// Help pages and the manual page, both made from the tables that also read the command line.

namespace carom {
namespace {

constexpr std::string_view purpose = "simulate scenes of rigid bodies, or open the IDE on one";

constexpr std::string_view exitCodes =
    "0 done; 1 the scene has errors; 2 wrong usage; 3 a file cannot be read or written, or memory has run "
    "out; "
    "4 the simulation lost a finite state, or gained energy from nowhere; 5 a stability case fails; 130 "
    "interrupted.";

std::string indented(std::string_view text) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        result.append("  ").append(text.substr(begin, end - begin)).append("\n");
        begin = end + 1;
    }
    return result;
}

std::string usageOf(const CommandRow& command) {
    std::string usage = "carom ";
    usage.append(command.name);
    if (!command.operands.empty()) usage.append(" ").append(command.operands);
    return usage + (command.options.empty() ? "" : " [OPTION]...");
}

std::vector<OptionRow> withHelp(std::span<const OptionRow> rows) {
    std::vector<OptionRow> result(rows.begin(), rows.end());
    result.push_back({"help", 'h', "", "print this page"});
    return result;
}

/// Text that troff takes literally.
std::string troff(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    // A line that begins with a full stop or an apostrophe would be a request.
    for (std::size_t at = 0; at < result.size(); ++at)
        if ((at == 0 || result[at - 1] == '\n') && (result[at] == '.' || result[at] == '\''))
            result.insert(at, "\\&");
    return result;
}

std::string optionsAsTroff(std::span<const OptionRow> rows) {
    std::string result;
    for (const OptionRow& row : rows) {
        result.append(".TP\n");
        if (row.letter) result.append("\\fB\\-").append(1, row.letter).append("\\fR, ");
        result.append("\\fB\\-\\-").append(troff(row.name)).append("\\fR");
        if (!row.argument.empty()) result.append(" \\fI").append(troff(row.argument)).append("\\fR");
        result.append("\n").append(troff(row.help)).append("\n");
    }
    return result;
}

std::string exampleAsTroff(std::string_view example) {
    return std::string(".PP\n.EX\n").append(troff(example)).append("\n.EE\n");
}

} // namespace

std::string helpOf(const CommandRow& command) {
    std::string page = "Usage: " + usageOf(command) + "\n";
    page.append(command.summary).append(".\n\nOptions:\n").append(describe(withHelp(command.options)));
    if (!command.details.empty()) page.append("\n").append(wrapped(command.details, 0, 0)).append("\n");
    page.append("\nExample:\n").append(indented(command.example));
    return page;
}

std::string helpOfProgram() {
    std::string page = "Usage: carom [SCENE] [OPTION]...\n       carom SUBCOMMAND ...\n";
    page.append("Carom: ").append(purpose).append(".\n\nSubcommands (no display needed; each has --help):\n");
    constexpr std::size_t nameWidth = 17;
    for (const CommandRow& command : commands()) {
        page.append("  ").append(command.name).append(std::string(nameWidth - command.name.size(), ' '));
        page.append(command.summary).append("\n");
    }
    page.append("\nOptions without a subcommand, for the IDE:\n").append(describe(withHelp(ideOptions())));
    page.append("\n").append(wrapped("Exit codes: " + std::string(exitCodes), 0, 0));
    page.append("\n\nExample:\n  carom scenes/pool_break.sdl --play\n");
    return page;
}

std::string manualPage() {
    std::string page = ".\\\" Made from the tables of options in app/; a test compares.\n";
    page.append(".TH CAROM 1 \"\" \"carom ").append(version()).append("\" \"User Commands\"\n");
    page.append(".SH NAME\ncarom \\- ").append(purpose).append("\n");
    page.append(".SH SYNOPSIS\n.B carom\n[\\fISCENE\\fR] [\\fIOPTION\\fR]...\n");
    for (const CommandRow& command : commands())
        page.append(".br\n.B carom ")
            .append(command.name)
            .append("\n")
            .append(troff(command.operands))
            .append(" [\\fIOPTION\\fR]...\n");
    page.append(
        ".SH DESCRIPTION\nWithout a subcommand\n.B carom\nopens the IDE. With one it needs no display. A "
        "scene is a file name, or \\- for standard input.\n");
    page.append(".SH OPTIONS\n").append(optionsAsTroff(withHelp(ideOptions())));
    for (const CommandRow& command : commands()) {
        page.append(".SH CAROM ");
        for (const char c : command.name) page += c == ' ' ? c : static_cast<char>(c - 'a' + 'A');
        page.append("\n")
            .append(troff(command.summary))
            .append(".\n")
            .append(optionsAsTroff(command.options));
        if (!command.details.empty()) page.append(".PP\n").append(troff(command.details)).append("\n");
        page.append(exampleAsTroff(command.example));
    }
    page.append(".SH EXIT STATUS\n").append(troff(exitCodes)).append("\n");
    return page;
}

} // namespace carom
