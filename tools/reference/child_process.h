#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>

namespace swept {

/// A child that we talk to by its standard input and output, and whose messages on standard error are kept. Whatever
/// the child does, no call here hangs for longer than the patience given, raises a signal, or leaves a process behind.
class ChildProcess {
public:
    ChildProcess() = default;
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// @return false, and the reason in `error`, when the child cannot be started.
    bool start(const std::string& executable, const std::string& argument, std::string& error);
    /// @return false when the child has ended or does not read for `patience` seconds.
    bool send(const void* bytes, std::size_t size, double patience);
    /// Reads exactly `size` bytes. @return false when the child has ended or stays silent for `patience` seconds.
    bool receive(void* bytes, std::size_t size, double patience);
    /// Ends the child if it still runs. @return how it ended, in words, with what it said on standard error.
    std::string finish();

private:
    bool waitFor(short direction, double patience);

    pid_t process_ = -1;
    int socket_ = -1;
    int messages_ = -1;
    bool timedOut_ = false;
};

}  // namespace swept
