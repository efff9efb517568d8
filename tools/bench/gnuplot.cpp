#include "gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

extern char** environ;

namespace swept::bench {
namespace {

constexpr int kNotFound = 127;  // exit code of a child that found nothing to run

}  // namespace

GnuplotState runGnuplot(const std::string& directory, const std::string& script) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    std::string program = "gnuplot";
    std::string file = script;
    char* const arguments[] = {program.data(), file.data(), nullptr};
    pid_t process = -1;
    const int failure = posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        return failure == ENOENT || failure == EACCES ? GnuplotState::notInstalled : GnuplotState::refused;
    }
    int status = 0;
    if (waitpid(process, &status, 0) != process || !WIFEXITED(status)) { return GnuplotState::refused; }
    if (WEXITSTATUS(status) == kNotFound) { return GnuplotState::notInstalled; }
    return WEXITSTATUS(status) == 0 ? GnuplotState::drawn : GnuplotState::refused;
}

}  // namespace swept::bench
