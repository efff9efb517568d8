#include "child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

extern char** environ;

namespace swept {
namespace {

void closeIfOpen(int& descriptor) {
    if (descriptor >= 0) { close(descriptor); }
    descriptor = -1;
}

/// All that was written to the memory file, on one line.
std::string textOf(int descriptor) {
    std::string text;
    std::array<char, 1024> buffer{};
    lseek(descriptor, 0, SEEK_SET);
    for (ssize_t count = 0; (count = read(descriptor, buffer.data(), buffer.size())) > 0;) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    while (!text.empty() && text.back() == '\n') { text.pop_back(); }
    for (char& character : text) {
        if (character == '\n') { character = ' '; }
    }
    return text;
}

/// "file:line: function: Assertion `x' failed." without the path to somebody's build folder.
std::string withoutPlace(const std::string& text) {
    const std::size_t assertion = text.find("Assertion `");
    return assertion == std::string::npos ? text : text.substr(assertion);
}

}  // namespace

ChildProcess::~ChildProcess() { finish(); }

bool ChildProcess::start(const std::string& executable, const std::string& argument, std::string& error) {
    std::array<int, 2> ends{-1, -1};
    // Sockets, not pipes: writing to a dead child can then fail without a signal. Close-on-exec keeps other children
    // out.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        error = std::string("no socket for the child process: ") + std::strerror(errno);
        return false;
    }
    socket_ = ends[0];
    messages_ = memfd_create("messages", MFD_CLOEXEC);  // a file, as a full pipe would block the child
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    if (messages_ >= 0) { posix_spawn_file_actions_adddup2(&actions, messages_, STDERR_FILENO); }
    std::string name = "swept";
    std::string command = argument;
    std::array<char*, 3> arguments{name.data(), command.data(), nullptr};
    const int failure = posix_spawn(&process_, executable.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failure == 0) { return true; }
    process_ = -1;
    error = "cannot start " + executable + ": " + std::strerror(failure);
    return false;
}

bool ChildProcess::waitFor(short direction, double patience) {
    pollfd watched{socket_, direction, 0};
    const int milliseconds = static_cast<int>(patience * 1000);
    int ready = 0;
    do { ready = poll(&watched, 1, milliseconds); } while (ready < 0 && errno == EINTR);
    timedOut_ = timedOut_ || ready == 0;
    return ready > 0;
}

bool ChildProcess::send(const void* bytes, std::size_t size, double patience) {
    const auto* rest = static_cast<const char*>(bytes);
    while (size > 0) {
        if (socket_ < 0 || !waitFor(POLLOUT, patience)) { return false; }
        const ssize_t count = ::send(socket_, rest, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) { continue; }
        if (count <= 0) { return false; }
        rest += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

bool ChildProcess::receive(void* bytes, std::size_t size, double patience) {
    auto* rest = static_cast<char*>(bytes);
    while (size > 0) {
        if (socket_ < 0 || !waitFor(POLLIN, patience)) { return false; }
        const ssize_t count = recv(socket_, rest, size, MSG_DONTWAIT);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) { continue; }
        if (count <= 0) { return false; }
        rest += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

std::string ChildProcess::finish() {
    closeIfOpen(socket_);
    std::string ending;
    if (process_ > 0) {
        // A child that broke the talk off is already dying of its own signal; only a silent one has to be stopped.
        int status = 0;
        const bool mayBeStuck = timedOut_;
        if (mayBeStuck) { kill(process_, SIGKILL); }
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
        if (mayBeStuck) {
            ending = "gave no answer in time";
        } else if (WIFSIGNALED(status)) {
            ending = WTERMSIG(status) == SIGABRT ? "aborted" : "died of signal " + std::to_string(WTERMSIG(status));
        } else {
            ending = "ended with exit code " + std::to_string(WEXITSTATUS(status));
        }
        process_ = -1;
    }
    const std::string said = messages_ >= 0 ? withoutPlace(textOf(messages_)) : std::string();
    closeIfOpen(messages_);
    return said.empty() ? ending : ending + " (" + said + ")";
}

}  // namespace swept
