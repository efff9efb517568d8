#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../measures/reference.h"
#include "limits.h"
#include "search.h"
#include "store.h"
#include "team.h"

namespace swept::tune {

/// Told of the work: how many runs are done of those that are known to come.
using RunWatcher = std::function<void(std::size_t done, std::size_t known)>;

struct TuneOptions {
    Subject subject;
    std::vector<Limit> limits;
    Shard shard;
    int threads = 1;  ///< of this process
};

/// The reference of a scene, made when it is first asked for.
class LazyReference {
public:
    explicit LazyReference(const Subject& subject) : subject_(subject) {}
    const measures::Reference& get(const measures::RefinementWatcher& watch = {});
    /// What rows need to know of it.
    void tell(Knowledge& known, const measures::RefinementWatcher& watch = {});

private:
    const Subject& subject_;
    std::optional<measures::Reference> reference_;
};

/// Runs what the search asks for until it asks for nothing. Rows go to the store as they come (of other processes at
/// the end of a round), and into `known`.
/// @param store  null in processes other than the first
void tune(const TuneOptions& options, LazyReference& reference, Team& team, Store* store, Knowledge& known,
          const RunWatcher& watch);

}  // namespace swept::tune
