#include "tuner.h"

#include <algorithm>
#include <mutex>

#include "run_config.h"

namespace swept::tune {
namespace {

/// What the tracks of a shard ask for next; when they are done and the shard is all there is, the last runs.
std::vector<Config> wantedOf(const TuneOptions& options, const SearchSpace& space, const Knowledge& known) {
    std::vector<Config> wanted;
    const std::vector<Track> tracks = allTracks();
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (!options.shard.has(i)) { continue; }
        for (const Config& config : nextOf(tracks[i], options.subject, space, options.limits, known)) {
            if (std::find(wanted.begin(), wanted.end(), config) == wanted.end()) { wanted.push_back(config); }
        }
    }
    if (wanted.empty() && options.shard.isWhole()) { wanted = lastOf(options.subject, space, options.limits, known); }
    return wanted;
}

/// The share of one process, in threads; rows as lines of CSV.
std::string runShare(const std::vector<Config>& share, const TuneOptions& options, const measures::Reference& reference,
                     Store* store, const std::function<void()>& oneDone) {
    std::vector<std::string> lines(share.size());
    std::mutex mutex;
    runParallel(share.size(), options.threads, [&](std::size_t i) {
        lines[i] = csvLine(options.subject, runConfig(options.subject, share[i], reference));
        if (store != nullptr) { store->append(lines[i]); }
        const std::lock_guard lock(mutex);
        oneDone();
    });
    std::string all;
    for (const std::string& line : lines) { all += line; }
    return all;
}

}  // namespace

const measures::Reference& LazyReference::get(const measures::RefinementWatcher& watch) {
    if (!reference_) { reference_ = measures::makeReference(subject_.scene, subject_.ticks, watch); }
    return *reference_;
}

void LazyReference::tell(Knowledge& known, const measures::RefinementWatcher& watch) {
    const measures::Reference& reference = get(watch);
    known.hasReference = true;
    known.reference = reference.source;
    known.uncertainty = reference.uncertainty;
}

void tune(const TuneOptions& options, LazyReference& reference, Team& team, Store* store, Knowledge& known,
          const RunWatcher& watch) {
    const SearchSpace space = searchSpaceOf(options.subject.scene);
    const auto rank = static_cast<std::size_t>(team.rank());
    const auto size = static_cast<std::size_t>(team.size());
    std::size_t done = 0;
    for (;;) {
        const std::vector<Config> wanted = wantedOf(options, space, known);
        if (wanted.empty()) { return; }
        std::vector<Config> share;
        for (std::size_t i = rank; i < wanted.size(); i += size) { share.push_back(wanted[i]); }
        const std::size_t expected = done + wanted.size();
        std::size_t mine = 0;
        const auto oneDone = [&] { watch(std::min(done + size * ++mine, expected), expected); };
        const std::string lines = share.empty() ? "" : runShare(share, options, reference.get(), store, oneDone);
        const std::string all = team.gather(lines);
        if (store != nullptr && size > 1) {  // the first process has written its own lines, which come first
            store->append(all.substr(lines.size()));
        }
        std::string error;
        Knowledge found;
        parseCsv(csvHeader() + all, "rows", options.subject, found, error);
        known.add(found);
        done = expected;
    }
}

}  // namespace swept::tune
