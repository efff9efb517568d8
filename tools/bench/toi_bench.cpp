#include "toi_bench.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "../toi/toi_judge.h"

namespace swept::bench {
namespace {

/// Time that this thread has had of a processor, in seconds: others on the machine take their turns, and a pass is
/// short enough to be lost in one of theirs.
double threadSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr int kRounds = 15;             // passes of the fast ones
constexpr int kFewestRounds = 3;        // of the slow ones
constexpr double kEnoughSeconds = 0.2;  // after which a contestant is a slow one

/// A contestant with its queries, judged, and the passes it was timed on.
struct Entry {
    ToiContestant* contestant = nullptr;
    std::vector<ToiQuery> queries;
    std::vector<Toi> answers;
    std::vector<double> passes;  // seconds
    double spent = 0;
};

void count(ToiTally& tally, const ToiJudgement& judgement) {
    ++tally.queries;
    switch (judgement.verdict) {
        case ToiVerdict::right:
            ++tally.right;
            return;
        case ToiVerdict::missed:
            ++tally.missed;
            tally.deepestMiss = std::max(tally.deepestMiss, judgement.depth);
            return;
        case ToiVerdict::late:
            ++tally.late;
            tally.deepestLate = std::max(tally.deepestLate, judgement.depth);
            return;
        case ToiVerdict::early:
            ++tally.early;
            tally.widestGap = std::max(tally.widestGap, judgement.depth);
            return;
        case ToiVerdict::falseOverlap:
            ++tally.falseOverlap;
            return;
        case ToiVerdict::wrongReport:
            ++tally.wrongReport;
            return;
        case ToiVerdict::failed:
            ++tally.failed;
            return;
        case ToiVerdict::undecided:
            ++tally.undecided;
            return;
    }
}

Entry entryOf(ToiContestant& contestant, const std::vector<ToiQuery>& queries) {
    Entry entry;
    entry.contestant = &contestant;
    for (const ToiQuery& query : queries) {
        if (const std::optional<ToiQuery> understood = contestant.understood(query)) {
            entry.queries.push_back(*understood);
        }
    }
    entry.answers.resize(entry.queries.size());
    contestant.load(entry.queries);
    contestant.answerAll(entry.answers);  // also the warm-up
    return entry;
}

ToiTally judged(const Entry& entry) {
    ToiTally tally;
    for (std::size_t i = 0; i < entry.queries.size(); ++i) {
        const ToiQuery& query = entry.queries[i];
        const std::optional<MixedTurns> turns = entry.contestant->turnsOf(query);
        count(tally, turns ? judgeToiEvent(query, entry.answers[i], *turns) : judgeToiEvent(query, entry.answers[i]));
    }
    return tally;
}

void timeOnePass(Entry& entry) {
    const double start = threadSeconds();
    entry.contestant->answerAll(entry.answers);
    const double seconds = threadSeconds() - start;
    entry.passes.push_back(seconds);
    entry.spent += seconds;
}

/// Pass by pass in turns, so that a disturbance of the machine meets all of them.
void timeInTurns(std::vector<Entry>& entries) {
    for (int round = 0; round < kRounds; ++round) {
        for (Entry& entry : entries) {
            if (!entry.queries.empty() && (round < kFewestRounds || entry.spent < kEnoughSeconds)) {
                timeOnePass(entry);
            }
        }
    }
}

double medianOf(std::vector<double> values) {
    if (values.empty()) { return 0; }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

ToiBenchRow rowOf(const Entry& entry, std::string_view family) {
    ToiBenchRow row;
    row.family = family;
    row.method = entry.contestant->name();
    row.tally = judged(entry);
    if (entry.contestant->tellsIterations()) {
        for (const Toi& answer : entry.answers) { row.iterations.push_back(answer.iterations); }
    }
    std::sort(row.iterations.begin(), row.iterations.end());
    if (!entry.queries.empty()) {
        row.nanoseconds = 1e9 * medianOf(entry.passes) / static_cast<double>(entry.queries.size());
    }
    return row;
}

std::vector<ToiQuery> queriesOf(ToiFamily family, const ToiBenchSettings& settings) {
    std::vector<ToiQuery> queries;
    for (int i = 0; i < settings.count; ++i) {
        queries.push_back(makeToiCase(family, settings.seed, static_cast<std::uint64_t>(i)));
    }
    return queries;
}

}  // namespace

void ToiTally::add(const ToiTally& other) {
    queries += other.queries;
    right += other.right;
    missed += other.missed;
    late += other.late;
    early += other.early;
    falseOverlap += other.falseOverlap;
    failed += other.failed;
    wrongReport += other.wrongReport;
    undecided += other.undecided;
    deepestMiss = std::max(deepestMiss, other.deepestMiss);
    deepestLate = std::max(deepestLate, other.deepestLate);
    widestGap = std::max(widestGap, other.widestGap);
}

int ToiBenchRow::iterationsOf(double share) const {
    if (iterations.empty()) { return 0; }
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(iterations.size())));
    return iterations[std::max<std::size_t>(rank, 1) - 1];
}

std::vector<ToiBenchRow> benchToi(const ToiContestants& contestants, const ToiBenchSettings& settings,
                                  const BenchProgress& progress) {
    std::vector<ToiBenchRow> rows;
    const int all = static_cast<int>(kToiFamilies.size() * contestants.size());
    for (const ToiFamily family : kToiFamilies) {
        const std::vector<ToiQuery> queries = queriesOf(family, settings);
        std::vector<Entry> entries;
        for (const auto& contestant : contestants) { entries.push_back(entryOf(*contestant, queries)); }
        timeInTurns(entries);
        for (const Entry& entry : entries) {
            rows.push_back(rowOf(entry, nameOf(family)));
            progress(static_cast<int>(rows.size()), all);
        }
    }
    return rows;
}

std::vector<TurnPoint> benchTurns(const ToiContestants& contestants, const ToiBenchSettings& settings,
                                  const BenchProgress& progress) {
    constexpr double kTurns[] = {0.01, 0.03, 0.1, 0.3, 0.785, 1.57, 3.14, 6.28, 12.57, 25.13};
    std::vector<TurnPoint> points;
    const int all = static_cast<int>(std::size(kTurns) * contestants.size());
    for (const double turn : kTurns) {
        std::vector<ToiQuery> queries = queriesOf(ToiFamily::generic, settings);
        for (ToiQuery& query : queries) {
            for (Sweep* const sweep : {&query.sweepA, &query.sweepB}) {
                sweep->a1 = sweep->a0 + (sweep->a1 < sweep->a0 ? -turn : turn);
            }
        }
        for (const auto& contestant : contestants) {
            const Entry entry = entryOf(*contestant, queries);
            points.push_back({contestant->name(), turn, judged(entry)});
            progress(static_cast<int>(points.size()), all);
        }
    }
    return points;
}

}  // namespace swept::bench
