#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../toi/toi_judge.h"
#include "../toi/toi_query.h"

namespace swept::bench {

/// Somebody who answers time-of-impact queries: one of our methods, or another engine.
class ToiContestant {
public:
    virtual ~ToiContestant() = default;

    virtual std::string name() const = 0;

    /// The query as the contestant is asked and judged: rounded to its numbers, with its own target and tolerance.
    /// Empty when it cannot be asked at all.
    virtual std::optional<ToiQuery> understood(const ToiQuery& query) const = 0;

    /// How its bodies turn in such a query, when it is not at a constant rate.
    virtual std::optional<MixedTurns> turnsOf(const ToiQuery&) const { return std::nullopt; }

    /// Takes queries that `understood` returned, in its own form, so that a pass over them is the answering alone.
    virtual void load(std::span<const ToiQuery> queries) = 0;

    /// Answers all that is loaded, in order. Only state, fraction and iterations need be written.
    virtual void answerAll(std::span<Toi> answers) = 0;

    /// Whether its answers have iterations.
    virtual bool tellsIterations() const { return true; }
};

using ToiContestants = std::vector<std::unique_ptr<ToiContestant>>;

/// All methods of `toi/`, in the order of their table, then the other engines of this build, and the default method on
/// their queries.
ToiContestants allToiContestants();

}  // namespace swept::bench
