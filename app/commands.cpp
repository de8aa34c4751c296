// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/version.h"
#include "core/base/catalogue.h"
#include "core/base/memory_limit.h"
#include "core/base/text.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace carom {

#define CAROM_COMMAND(function) CommandRow function();
#include "app/commands.def"
#undef CAROM_COMMAND

std::span<const CommandRow> commands() {
    static const std::vector<CommandRow> rows = {
#define CAROM_COMMAND(function) function(),
#include "app/commands.def"
#undef CAROM_COMMAND
    };
    return rows;
}

std::span<const OptionRow> ideOptions() {
    static const std::vector<OptionRow> rows = {
        {"frames", 'n', "FRAMES", "leave after FRAMES rendered frames and print the timing statistics"},
        {"play", 0, "", "start playing at once"},
        {"screenshot", 0, "FILE", "save the window as a PNG before leaving (with -n)"},
        {"picture", 0, "FILE", "save the picture of SCENE as a PNG and leave; no window is opened"},
        {"at", 0, "FRAME", "the frame of --picture; the first unless said"},
        {"size", 0, "WxH", "the size of --picture in pixels; 960x600 unless said"},
        {"version", 0, "", "print the version"},
    };
    return rows;
}

namespace {

/// `words` are those of the whole command line, the first `named` of which name the command.
int runCommand(const CommandRow& command, std::size_t named, const std::string& program,
               std::span<const std::string> words, const QtParts& parts) {
    const Arguments arguments = readArguments(words.subspan(named), command.options);
    if (arguments.has("help")) {
        printOut(helpOf(command));
        return exitcode::done;
    }
    if (arguments.operands.size() < command.leastOperands)
        throw UsageError("missing " + std::string(command.operands));
    if (arguments.operands.size() > command.mostOperands)
        throw UsageError("`" + arguments.operands[command.mostOperands] +
                         "` is one operand too many; it takes " + std::string(command.operands));
    const bool draws =
        command.drawsCharts && (arguments.has("output") || arguments.has("chart") || arguments.has("merge"));
    if (draws && parts.handOn) parts.handOn(program, words);
    limitMemory();
    return command.run(arguments);
}

bool hasDisplay() {
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
        if (const char* value = std::getenv(variable); value && *value) return true;
    return false;
}

/// How many words the command line begins with that name this command: `study gas` is two; 0 if it does not.
std::size_t wordsNaming(const CommandRow& command, std::span<const std::string> words) {
    std::string said;
    for (std::size_t count = 1; count <= words.size() && said.size() < command.name.size(); ++count) {
        said.append(count > 1 ? " " : "").append(words[count - 1]);
        if (said == command.name) return count;
    }
    return 0;
}

/// `study` alone, or with a name that is none: what could follow it.
void rejectUnknownMember(std::span<const std::string> words) {
    const std::string family = words.empty() ? "" : words.front() + " ";
    std::vector<std::string_view> members;
    for (const CommandRow& command : commands())
        if (command.name.starts_with(family)) members.push_back(command.name.substr(family.size()));
    if (words.empty() || members.empty()) return;
    const std::string seen = words.size() > 1 ? "there is no " + family + "`" + words[1] + "`"
                                              : "`" + words.front() + "` alone says too little";
    throw UsageError(seen + "; it must be `" + words.front() + "` followed by " + listOf(members));
}

/// A first word that is no subcommand is a scene for the IDE, or a mistyped command.
void rejectSlip(const std::vector<std::string>& operands) {
    const std::string& word = operands.front();
    if (::access(word.c_str(), F_OK) == 0) return;
    const std::optional<std::string_view> near = nearestRow(word, commands());
    if (near || operands.size() > 1)
        throw UsageError("`" + word + "` is neither a subcommand nor a file" +
                         (near ? "; did you mean `" + std::string(*near) + "`?" : ""));
}

/// "480x300" into the request's size.
void readSize(const std::string& text, PictureRequest& picture) {
    constexpr long long least = 16, most = 16384; // [px]
    const std::size_t x = std::min(text.find('x'), text.size());
    const std::string_view behind = std::string_view(text).substr(std::min(x + 1, text.size()));
    const long long width = wholeNumberIn(std::string_view(text).substr(0, x)).value_or(0);
    const long long height = wholeNumberIn(behind).value_or(0);
    if (width < least || width > most || height < least || height > most)
        throw UsageError("`--size` is `" + text +
                         "`; it must be two whole numbers from 16 to 16384 such as `960x600`");
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
}

std::optional<PictureRequest> readPicture(const Arguments& arguments) {
    const std::optional<std::string> file = arguments.text("picture");
    if (!file) {
        for (const char* option : {"at", "size"})
            if (arguments.has(option))
                throw UsageError("`--" + std::string(option) +
                                 "` belongs to `--picture`, which is not there");
        return std::nullopt;
    }
    if (arguments.operands.empty()) throw UsageError("`--picture` needs a scene");
    PictureRequest picture{*file};
    picture.frame = arguments.wholeNumber("at", 0, std::numeric_limits<std::int64_t>::max()).value_or(0);
    if (const std::optional<std::string> size = arguments.text("size")) readSize(*size, picture);
    return picture;
}

int openIde(const std::string& program, std::span<const std::string> words, const QtParts& parts) {
    const Arguments arguments = readArguments(words, ideOptions());
    if (arguments.has("help")) {
        printOut(helpOfProgram());
        return exitcode::done;
    }
    if (arguments.has("version")) {
        printOut("carom " + std::string(version()) + "\n");
        return exitcode::done;
    }
    if (!arguments.operands.empty()) rejectSlip(arguments.operands);
    if (arguments.operands.size() > 1)
        throw UsageError("`" + arguments.operands[1] + "` is one scene too many; the IDE opens one");
    IdeRequest request;
    request.program = program;
    if (!arguments.operands.empty()) request.scene = arguments.operands.front();
    request.frames = arguments.wholeNumber("frames", 1, std::numeric_limits<std::int64_t>::max());
    request.play = arguments.has("play");
    request.screenshot = arguments.text("screenshot");
    request.picture = readPicture(arguments);
    refuseSharedFiles({{"the scene", request.scene.value_or("")},
                       {"`--picture`", request.picture ? request.picture->file : ""},
                       {"`--screenshot`", request.screenshot.value_or("")}});
    if (!parts.ide && !parts.handOn)
        throw UsageError("this build has no IDE; `carom run SCENE` simulates without it");
    if (!hasDisplay())
        throw UsageError("there is no display to open the IDE on; `carom run SCENE` simulates without one");
    if (parts.handOn) parts.handOn(program, words);
    return parts.ide(request);
}

/// The subcommand that the first words name, and how many of them do.
std::pair<const CommandRow*, std::size_t> commandNamed(std::span<const std::string> words) {
    const CommandRow* command = nullptr;
    std::size_t named = 0;
    for (const CommandRow& row : commands())
        if (const std::size_t count = wordsNaming(row, words); count > named) {
            command = &row;
            named = count;
        }
    return {command, named};
}

} // namespace

int runCommandLine(const std::string& program, std::span<const std::string> words, const QtParts& parts) {
    // A closed pipe is a write error like any other, and does not end the program by a signal.
    std::signal(SIGPIPE, SIG_IGN);
    std::string who = "carom";
    try {
        const auto [command, named] = commandNamed(words);
        if (command) {
            who.append(" ").append(command->name);
            return runCommand(*command, named, program, words, parts);
        }
        rejectUnknownMember(words);
        return openIde(program, words, parts);
    } catch (const UsageError& error) {
        printError(who + ": " + error.what() + "\nTry `" + who + " --help`.\n");
        return exitcode::wrongUsage;
    } catch (const FileError& error) {
        if (!error.isBrokenPipe()) printError(who + ": " + error.what() + "\n");
        return exitcode::fileError;
    } catch (const TextTooLarge& error) {
        printError(who + ": " + error.what() + "\n");
        return exitcode::sceneHasErrors;
    } catch (const std::bad_alloc&) {
        printError(who + ": there is not enough memory for this scene\n");
        return exitcode::fileError;
    } catch (const std::length_error&) { // an array longer than any memory
        printError(who + ": there is not enough memory for this scene\n");
        return exitcode::fileError;
    } catch (const std::exception& error) {
        printError(who + ": stopped by an error inside the program: " + error.what() + "\n");
        return exitcode::fileError;
    }
}

} // namespace carom
