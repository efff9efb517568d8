#include "code_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace swept::house {

bool isWordChar(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

namespace {

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Copies a text while blanking what is not code. Newlines always stay.
class Blanker {
public:
    explicit Blanker(std::string_view text) : text_(text), out_(text) {}

    std::string run(bool keepPreprocessor) {
        bool lineStart = true;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '/' && next() == '/') {
                blankWhile([this] { return text_[at_] != '\n' || text_[at_ - 1] == '\\'; });
            } else if (c == '/' && next() == '*') {
                blankUntilAfter("*/", at_ + 2);
            } else if (c == '#' && lineStart && !keepPreprocessor) {
                blankDirective();
            } else if (c == '#' && lineStart) {
                while (at_ < text_.size() && text_[at_] != '\n' && !text_.substr(at_).starts_with("//")) { ++at_; }
            } else if (c == '"') {
                blankString();
            } else if (c == '\'' && !(at_ > 0 && isWordChar(text_[at_ - 1]))) {  // else a digit separator
                blankLiteral('\'');
            } else {
                lineStart = c == '\n' || (lineStart && isSpace(c));
                ++at_;
                continue;
            }
            lineStart = false;
        }
        return out_;
    }

private:
    char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

    void blankOne() {
        if (text_[at_] != '\n') { out_[at_] = ' '; }
        ++at_;
    }
    template <class Condition>
    void blankWhile(const Condition& condition) {
        while (at_ < text_.size() && condition()) { blankOne(); }
    }
    void blankUntilAfter(std::string_view end, std::size_t from) {
        const std::size_t found = text_.find(end, from);
        const std::size_t stop = found == std::string_view::npos ? text_.size() : found + end.size();
        blankWhile([&] { return at_ < stop; });
    }
    void blankDirective() {
        blankWhile([this] { return text_[at_] != '\n' || text_[at_ - 1] == '\\'; });
    }
    void blankString() {
        const bool raw = at_ > 0 && text_[at_ - 1] == 'R';
        if (!raw) {
            blankLiteral('"');
            return;
        }
        const std::size_t open = text_.find('(', at_);
        std::string end(text_.substr(at_ + 1, open - at_ - 1));
        end.insert(end.begin(), ')');
        end.push_back('"');
        blankUntilAfter(end, open);
    }
    /// Keeps the quotes themselves, so that `""` still is something.
    void blankLiteral(char quote) {
        ++at_;
        while (at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n') {
            if (text_[at_] == '\\') { blankOne(); }
            if (at_ < text_.size()) { blankOne(); }
        }
        if (at_ < text_.size() && text_[at_] == quote) { ++at_; }
    }

    std::string_view text_;
    std::string out_;
    std::size_t at_ = 0;
};

/// Place behind the bracket that closes the one at `open`.
std::size_t afterMatching(std::string_view code, std::size_t open) {
    const char opening = code[open];
    const char closing = opening == '(' ? ')' : opening == '{' ? '}' : '>';
    int depth = 0;
    for (std::size_t i = open; i < code.size(); ++i) {
        if (code[i] == opening) { ++depth; }
        if (code[i] == closing && --depth == 0) { return i + 1; }
    }
    return code.size();
}

std::string trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front())) { text.remove_prefix(1); }
    while (!text.empty() && isSpace(text.back())) { text.remove_suffix(1); }
    return std::string(text);
}

/// Without `template <…>` in front and without everything in parentheses.
std::string bareHead(std::string_view head) {
    std::string text = trimmed(head);
    while (text.starts_with("template")) {
        const std::size_t open = text.find('<');
        if (open == std::string::npos) { break; }
        text = trimmed(std::string_view(text).substr(afterMatching(text, open)));
    }
    std::string bare;
    int depth = 0;
    for (const char c : text) {
        if (c == '(') { ++depth; }
        if (depth == 0) { bare += c; }
        if (c == ')') { --depth; }
    }
    return bare;
}

bool hasWord(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const bool starts = at == 0 || !isWordChar(text[at - 1]);
        const bool ends = at + word.size() >= text.size() || !isWordChar(text[at + word.size()]);
        if (starts && ends) { return true; }
    }
    return false;
}

/// Whether a block with this head is one that holds declarations.
bool opensScope(std::string_view head) {
    const std::string bare = bareHead(head);
    constexpr std::array kWords = {"namespace", "class", "struct", "union", "enum", "extern"};
    return std::any_of(kWords.begin(), kWords.end(), [&](const char* word) { return hasWord(bare, word); });
}

/// Whether a brace behind this head begins the value of a member in a constructor's list, as in `Foo() : a_{1}`.
bool isMemberInitializer(std::string_view head) {
    const std::size_t open = head.find('(');
    if (open == std::string_view::npos) { return false; }
    const std::string_view rest = head.substr(afterMatching(head, open));
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const bool single =
            rest[i] == ':' && (i + 1 >= rest.size() || rest[i + 1] != ':') && (i == 0 || rest[i - 1] != ':');
        if (!single) { continue; }
        const std::string before = trimmed(rest);
        return isWordChar(before.back()) || before.back() == '>';
    }
    return false;
}

}  // namespace

std::string codeOnly(std::string_view text) { return Blanker(text).run(false); }

std::vector<FunctionSpan> functionsIn(std::string_view text) {
    const std::string code = codeOnly(text);
    std::vector<FunctionSpan> functions;
    std::size_t headStart = 0;
    for (std::size_t i = 0; i < code.size();) {
        const char c = code[i];
        if (c == ';' || c == '}') {
            headStart = ++i;
            continue;
        }
        if (c == '(') {  // braces in parentheses belong to an expression
            i = afterMatching(code, i);
            continue;
        }
        if (c != '{') {
            ++i;
            continue;
        }
        const std::string_view head = std::string_view(code).substr(headStart, i - headStart);
        if (opensScope(head)) {
            headStart = ++i;
            continue;
        }
        const std::size_t end = afterMatching(code, i);
        if (isMemberInitializer(head)) {
            i = end;
            continue;
        }
        if (head.find('(') != std::string_view::npos) {
            const std::size_t first =
                headStart + static_cast<std::size_t>(
                                std::distance(head.begin(), std::find_if_not(head.begin(), head.end(), isSpace)));
            std::string oneLine = trimmed(head);
            std::replace(oneLine.begin(), oneLine.end(), '\n', ' ');
            functions.push_back({oneLine, lineCount(std::string_view(code).substr(0, first + 1)),
                                 lineCount(std::string_view(code).substr(0, end))});
        }
        headStart = i = end;
    }
    return functions;
}

std::vector<Include> includesIn(std::string_view text) {
    const std::string kept = Blanker(text).run(true);
    std::vector<Include> includes;
    int line = 0;
    for (std::size_t start = 0; start < kept.size();) {
        ++line;
        const std::size_t end = std::min(kept.find('\n', start), kept.size());
        const std::string row = trimmed(std::string_view(kept).substr(start, end - start));
        start = end + 1;
        if (!row.starts_with('#')) { continue; }
        const std::string directive = trimmed(std::string_view(row).substr(1));
        if (!directive.starts_with("include")) { continue; }
        const std::size_t open = directive.find_first_of("<\"");
        if (open == std::string::npos) { continue; }
        const bool quoted = directive[open] == '"';
        const std::size_t close = directive.find(quoted ? '"' : '>', open + 1);
        includes.push_back({directive.substr(open + 1, close - open - 1), quoted, line});
    }
    return includes;
}

int lineCount(std::string_view text) {
    const auto newlines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    return text.empty() || text.back() == '\n' ? newlines : newlines + 1;
}

}  // namespace swept::house
