#include "../../toi/toi_method.h"
#include "box2d_toi.h"
#include "toi_contestant.h"
#ifdef SWEPT_BENCH_BOX2D3
#include "box2d3/box2d3_toi.h"
#endif

namespace swept::bench {
namespace {

class OurMethod final : public ToiContestant {
public:
    explicit OurMethod(ToiMethod method) : method_(method) {}

    std::string name() const override { return std::string(nameOf(method_)); }
    std::optional<ToiQuery> understood(const ToiQuery& query) const override { return query; }
    void load(std::span<const ToiQuery> queries) override { queries_.assign(queries.begin(), queries.end()); }

    void answerAll(std::span<Toi> answers) override {
        for (std::size_t i = 0; i < queries_.size(); ++i) {
            const ToiQuery& q = queries_[i];
            answers[i] = timeOfImpactBy(method_, q.a, q.sweepA, q.b, q.sweepB, q.settings);
        }
    }

private:
    ToiMethod method_;
    std::vector<ToiQuery> queries_;
};

/// The default method on exactly what an engine is asked: its numbers, its target and tolerance; and told to answer
/// what the engine answers: the event, without normal, points or depth.
class CertifiedAs final : public ToiContestant {
public:
    CertifiedAs(std::unique_ptr<ToiContestant> engine, std::string name)
        : engine_(std::move(engine)), name_(std::move(name)) {}

    std::string name() const override { return name_; }

    std::optional<ToiQuery> understood(const ToiQuery& query) const override {
        const std::optional<ToiQuery> q = engine_->understood(query);
        return q && validateToi(q->a, q->sweepA, q->b, q->sweepB, q->settings).ok() ? q : std::nullopt;
    }
    void load(std::span<const ToiQuery> queries) override {
        std::vector<ToiQuery> events(queries.begin(), queries.end());
        for (ToiQuery& q : events) { q.settings.detail = ToiDetail::event; }
        method_.load(events);
    }
    void answerAll(std::span<Toi> answers) override { method_.answerAll(answers); }

private:
    std::unique_ptr<ToiContestant> engine_;
    std::string name_;
    OurMethod method_{ToiMethod::certified};
};

}  // namespace

ToiContestants allToiContestants() {
    ToiContestants all;
    for (const ToiMethodInfo& info : kToiMethods) { all.push_back(std::make_unique<OurMethod>(info.method)); }
    all.push_back(makeBox2dToi());
    all.push_back(std::make_unique<CertifiedAs>(makeBox2dToi(), "certified as Box2D"));
#ifdef SWEPT_BENCH_BOX2D3
    all.push_back(makeBox2d3Toi());
    all.push_back(std::make_unique<CertifiedAs>(makeBox2d3Toi(), "certified as Box2D 3"));
#endif
    return all;
}

}  // namespace swept::bench
