#include "row.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>

#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>

#include "../writers/csv_writer.h"
#include "../writers/number_text.h"

namespace swept::tune {
namespace {

constexpr const char* kReference = "reference";
/// Part of what is hashed: another number when measures or columns come to mean something else.
/// Rows of another engine are not compared with those of this one.
constexpr const char* kFormat = "tune 1 " SWEPT_VERSION " ";

/// The fields of a line without quotes, or of one whose quoted fields hold no line breaks.
std::vector<std::string> fieldsOfLine(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

template <class Number>
bool parseNumber(const std::string& text, Number& number) {
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    return failure == std::errc{} && end == text.data() + text.size();
}

template <class Enumeration>
bool parseName(const std::string& text, Enumeration& value) {
    const auto names = namesOf<Enumeration>();
    const auto found = std::find(names.begin(), names.end(), text);
    value = static_cast<Enumeration>(found - names.begin());
    return found != names.end();
}

/// An empty field is no number.
bool parseOptional(const std::string& text, double& number) {
    number = std::numeric_limits<double>::quiet_NaN();
    return text.empty() || parseNumber(text, number);
}

bool parseEngine(const std::string& text, Engine& engine) {
    for (int i = 0; i < kEngineCount; ++i) {
        engine = static_cast<Engine>(i);
        if (text == nameOf(engine)) { return true; }
    }
    return false;
}

// Columns: fingerprint, engine … broadphase (8), verdict, cost, work, measures.
constexpr std::size_t kFixedColumns = 12;

bool parseValues(const std::vector<std::string>& fields, measures::Values& values) {
    bool ok = true;
    for (std::size_t i = 0; i < measures::kMeasureCount; ++i) {
        ok = ok && parseOptional(fields[kFixedColumns + i], values[static_cast<measures::Measure>(i)]);
    }
    return ok;
}

bool parseRow(const std::vector<std::string>& fields, Row& row) {
    Config& config = row.config;
    double tolerance = 0;
    const bool ok = parseEngine(fields[1], config.engine) && parseNumber(fields[2], config.dtPower) &&
                    parseNumber(fields[4], config.subSteps) && parseNumber(fields[5], config.relaxPasses) &&
                    parseName(fields[6], config.continuous) && parseOptional(fields[7], tolerance) &&
                    parseName(fields[8], config.broadphase) && parseNumber(fields[10], row.cost) &&
                    parseNumber(fields[11], row.work) && parseValues(fields, row.errors);
    if (!fields[7].empty()) { config.toiTolerance = tolerance; }
    row.verdict = fields[9];
    return ok;
}

std::string valuesText(const measures::Values& values) {
    std::string text;
    for (std::size_t i = 0; i < measures::kMeasureCount; ++i) {
        const double value = values[static_cast<measures::Measure>(i)];
        text += ',';
        if (value == value) { appendNumber(text, value); }
    }
    return text;
}

}  // namespace

std::string Subject::fingerprint() const {
    constexpr std::uint64_t kBasis = 14695981039346656037U;
    constexpr std::uint64_t kPrime = 1099511628211U;
    std::uint64_t hash = kBasis;
    for (const char c : kFormat + std::to_string(ticks) + writeScene(scene)) {
        hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
    }
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

const Row* Knowledge::find(const Config& config) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.config == config; });
    return found == rows.end() ? nullptr : &*found;
}

void Knowledge::add(const Knowledge& more) {
    for (const Row& row : more.rows) {
        if (find(row.config) == nullptr) { rows.push_back(row); }
    }
    if (more.hasReference && !hasReference) {
        hasReference = true;
        reference = more.reference;
        uncertainty = more.uncertainty;
    }
}

std::string csvHeader() {
    std::string text = std::string("scene,") + kConfigColumns + ",verdict,costPerSecond,work";
    for (const measures::MeasureInfo& info : measures::allMeasures()) { text += std::string(",") + info.name; }
    return text + '\n';
}

std::string csvLine(const Subject& subject, const Row& row) {
    std::string text = subject.fingerprint() + ',' + fieldsOf(subject.scene, row.config) + ',';
    text += csvField(row.verdict) + ',';
    appendNumber(text, row.cost);
    text += ',';
    appendNumber(text, row.work);
    return text + valuesText(row.errors) + '\n';
}

std::string csvLineOfReference(const Subject& subject, const Knowledge& known) {
    return subject.fingerprint() + ',' + kReference + ",,,,,,,," + csvField(known.reference) + ",0,0" +
           valuesText(known.uncertainty) + '\n';
}

bool parseCsv(const std::string& text, const std::string& file, const Subject& subject, Knowledge& known,
              std::string& error) {
    const std::string header = csvHeader();
    if (!text.starts_with(header)) {
        error = file + ": is not a file of swept tune, or one of another version";
        return false;
    }
    const std::string fingerprint = subject.fingerprint();
    std::size_t line = 1;
    Knowledge found;
    for (std::size_t at = header.size(); at < text.size();) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string::npos) {
            break;  // the run that wrote it was interrupted
        }
        const std::vector<std::string> fields = fieldsOfLine(text.substr(at, end - at));
        at = end + 1;
        ++line;
        Row row;
        if (fields.size() != kFixedColumns + measures::kMeasureCount) {
            error = file + ": line " + std::to_string(line) + ": has " +
                    countText(static_cast<std::int64_t>(fields.size()), "field");
            return false;
        }
        if (fields[0] != fingerprint) {
            error = file + ": line " + std::to_string(line) +
                    ": belongs to another scene, to a run of another length, or to another version of the engine";
            return false;
        }
        const bool isReference = fields[1] == kReference;
        if (isReference ? !parseValues(fields, found.uncertainty) : !parseRow(fields, row)) {
            error = file + ": line " + std::to_string(line) + ": cannot be read";
            return false;
        }
        if (isReference) {
            found.hasReference = true;
            found.reference = fields[9];
        } else if (found.find(row.config) == nullptr) {
            found.rows.push_back(row);
        }
    }
    known.add(found);
    return true;
}

}  // namespace swept::tune
