#include "team.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#ifdef SWEPT_MPI
#define OMPI_SKIP_MPICXX 1  // its C++ interface is obsolete, and not linked
#include <mpi.h>

#include <cstdlib>
#include <cstring>
#endif

namespace swept::tune {
namespace {

class Alone final : public Team {
public:
    int rank() const override { return 0; }
    int size() const override { return 1; }
    std::string gather(const std::string& mine) override { return mine; }
};

#ifdef SWEPT_MPI

/// Whether a launcher of MPI programs started this process: a plain start need not wait for MPI to set itself up.
bool isLaunched() {
    for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) {
        if (std::getenv(name) != nullptr) { return true; }
    }
    return false;
}

class MpiTeam final : public Team {
public:
    MpiTeam() {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
    }
    ~MpiTeam() override { MPI_Finalize(); }
    MpiTeam(const MpiTeam&) = delete;
    MpiTeam& operator=(const MpiTeam&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }

    std::string gather(const std::string& mine) override {
        const auto count = static_cast<std::size_t>(size_);
        const int length = static_cast<int>(mine.size());
        std::vector<int> lengths(count);
        MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
        std::vector<int> offsets(count);
        int total = 0;
        for (std::size_t i = 0; i < count; ++i) {
            offsets[i] = total;
            total += lengths[i];
        }
        std::string all(static_cast<std::size_t>(total), '\0');
        MPI_Allgatherv(mine.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR,
                       MPI_COMM_WORLD);
        return all;
    }

private:
    int rank_ = 0;
    int size_ = 1;
};

#endif

}  // namespace

bool builtWithMpi() {
#ifdef SWEPT_MPI
    return true;
#else
    return false;
#endif
}

std::unique_ptr<Team> makeTeam() {
#ifdef SWEPT_MPI
    if (isLaunched()) { return std::make_unique<MpiTeam>(); }
#endif
    return std::make_unique<Alone>();
}

void runParallel(std::size_t count, int threads, const std::function<void(std::size_t)>& run) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) { run(i); }
    };
    std::vector<std::jthread> others;
    const auto wanted = std::min(static_cast<std::size_t>(std::max(threads, 1)), count);
    for (std::size_t i = 1; i < wanted; ++i) { others.emplace_back(work); }
    work();
}

}  // namespace swept::tune
