#pragma once

#include <functional>
#include <memory>
#include <string>

namespace swept::tune {

/// The processes that tune together: one, or those that mpirun started.
class Team {
public:
    virtual ~Team() = default;
    virtual int rank() const = 0;  ///< 0 … size − 1; 0 writes and talks
    virtual int size() const = 0;
    /// What every process has to say, in the order of their ranks; each calls it equally often.
    virtual std::string gather(const std::string& mine) = 0;
};

/// Those that mpirun started, when this was built with MPI and mpirun started it; else this one alone.
std::unique_ptr<Team> makeTeam();
bool builtWithMpi();

/// Calls `run(i)` for i in [0, count) on so many threads, each index once; returns when all are done.
void runParallel(std::size_t count, int threads, const std::function<void(std::size_t)>& run);

}  // namespace swept::tune
