#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scratch_directory.h"

extern char** environ;

namespace swept {

struct ProgramResult {
    int exitCode = -1;  ///< −1: could not be started, or died of a signal
    std::string out;
    std::string err;
};

/// A leak sanitizer that lists the leaks it was told to overlook would add to the program's own messages.
inline void quietSuppressions() {
    const char* const given = getenv("LSAN_OPTIONS");
    setenv("LSAN_OPTIONS", (std::string(given != nullptr ? given : "") + ":print_suppressions=0").c_str(), 1);
}

/// Runs a program (looked for on the search path where it has no slash) to its end. Its streams are files, so that
/// nothing can block.
inline ProgramResult runProgram(const std::string& program, std::vector<std::string> arguments,
                                const std::string& input = "") {
    [[maybe_unused]] static const bool quiet = (quietSuppressions(), true);
    const ScratchDirectory scratch;
    const std::string in = scratch.write("in", input);
    const std::string out = scratch.path("out");
    const std::string err = scratch.path("err");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) { pointers.push_back(argument.data()); }
    pointers.push_back(nullptr);
    ProgramResult result;
    pid_t process = -1;
    int status = 0;
    const int failure = posix_spawnp(&process, program.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == 0 && waitpid(process, &status, 0) == process && WIFEXITED(status)) {
        result.exitCode = WEXITSTATUS(status);
    }
    result.out = scratch.read("out");
    result.err = scratch.read("err");
    return result;
}

/// Runs the built `swept`.
inline ProgramResult runSwept(const std::vector<std::string>& arguments, const std::string& input = "") {
    return runProgram(SWEPT_PROGRAM, arguments, input);
}

/// Runs `swept` with what it cannot do: exit code 2, one line on stderr that has `reason` in it, nothing on stdout.
inline void expectRefused(const std::vector<std::string>& arguments, const std::string& reason = "",
                          const std::string& input = "") {
    const ProgramResult result = runSwept(arguments, input);
    EXPECT_EQ(result.exitCode, 2) << arguments.back();
    EXPECT_EQ(result.err.substr(0, 7), "swept: ") << result.err;
    EXPECT_EQ(result.out, "") << arguments.back();
    EXPECT_NE(result.err.find(reason), std::string::npos) << reason << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

}  // namespace swept
