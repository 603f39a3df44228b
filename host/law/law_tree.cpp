#include "host/law/law_tree.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "host/law/law_cursor.h"

namespace vkdose {
namespace {

using Expression = LawExpression;
using Statement = LawStatement;

/// The signs between two operands, from those that bind least. && and || decide whether the second one is looked at.
const std::vector<std::vector<std::string_view>> kSigns{
    {"||"},       {"^^"},     {"&&"},         {"|"}, {"^"}, {"&"}, {"==", "!="}, {"<", ">", "<=", ">="},
    {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};
constexpr std::array<std::string_view, 11> kAssignments{
    "=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="};

Expression made(Expression::Kind kind, std::vector<Expression> operands, std::string word = {}) {
    Expression e;
    e.kind = kind;
    e.word = std::move(word);
    e.operands = std::move(operands);
    return e;
}

LawValue numberOf(const LawToken& t) {
    std::string text = t.text;
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    const bool whole = hexadecimal || text.find_first_of(".eEfF") == std::string::npos;
    if (!whole) {
        while (!isdigit(static_cast<unsigned char>(text.back())) && text.back() != '.') text.pop_back();
        double value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return lawNumber(value);
    }
    const bool isUnsigned = text.back() == 'u' || text.back() == 'U';
    const std::size_t from = hexadecimal ? 2 : 0;
    const int base = hexadecimal ? 16 : text.size() > 1 && text.front() == '0' ? 8 : 10;
    std::uint32_t value = 0;
    std::from_chars(text.data() + from, text.data() + text.size(), value, base);
    return isUnsigned ? lawNumber(value, LawBase::Uint) : lawNumber(double(std::int32_t(value)), LawBase::Int);
}

class Reader : private LawCursor {
  public:
    explicit Reader(const std::vector<LawToken>& tokens) : LawCursor(tokens) {}

    LawTree read() {
        while (at_ < tokens_.size()) readDeclaration();
        return std::move(tree_);
    }

  private:
    /// A variable that is known by its name until the block ends.
    std::size_t declare(const std::string& name) {
        known_[name] = tree_.places;
        return tree_.places++;
    }

    bool takes(std::string_view word) {
        const bool is = here(word);
        at_ += is ? 1 : 0;
        return is;
    }

    void readDeclaration() {
        if (isLawDeclarer(tokens_[at_])) {
            std::vector<std::size_t>& places = here("parameter") ? tree_.parameters
                                               : here("memory")  ? tree_.memories
                                                                 : tree_.properties;
            at_ += 2;
            do places.push_back(declare(name("a variable").text));
            while (takes(","));
            expect(";");
            return;
        }
        if (here("const")) {
            tree_.constants.push_back(readVariables());
            return;
        }
        readFunction();
    }

    void readFunction() {
        auto function = std::make_unique<LawFunction>();
        function->type = lawTypeOf(next("a type").text);
        function->name = next("a name").text;
        const std::map<std::string, std::size_t> outside = known_;
        expect("(");
        while (!takes(")")) {
            while (takes("const") || takes("in") || takes("precise")) {
            }
            const LawToken& type = next("a type");
            if (type.is("void")) continue;
            function->argumentTypes.push_back(lawTypeOf(type.text));
            function->arguments.push_back(declare(name("an argument").text));
            takes(",");
        }
        function->body = readStatement();
        known_ = outside;
        tree_.functions.push_back(std::move(function));
    }

    bool declares() const {
        std::size_t k = at_;
        while (k + 1 < tokens_.size() && (tokens_[k].is("const") || tokens_[k].is("precise"))) ++k;
        const LawToken& t = tokens_[k];
        return (isLawType(t.text) || t.is("Contact")) && k + 1 < tokens_.size() && !tokens_[k + 1].is("(");
    }

    /// One type, and variables with their values.
    Statement readVariables() {
        while (takes("const") || takes("precise")) {
        }
        const LawType type = lawTypeOf(next("a type").text);
        Statement all;
        do {
            const std::string variable = name("a variable").text;
            expect("=");
            Statement one;
            one.kind = Statement::Kind::Declare;
            one.type = type;
            one.expressions.push_back(readAssignment());  // before the name is known
            one.place = declare(variable);
            all.inner.push_back(std::move(one));
        } while (takes(","));
        expect(";");
        return all.inner.size() == 1 ? std::move(all.inner.front()) : all;
    }

    Statement readStatement() {
        Statement s;
        if (takes("{")) {
            const std::map<std::string, std::size_t> outside = known_;
            while (!takes("}")) s.inner.push_back(readStatement());
            known_ = outside;
            return s;
        }
        if (takes(";")) return s;
        if (takes("if")) return readIf();
        if (takes("for")) return readFor();
        if (declares()) return readVariables();
        if (takes("break"))
            s.kind = Statement::Kind::Break;
        else if (takes("continue"))
            s.kind = Statement::Kind::Continue;
        else if (takes("return")) {
            s.kind = Statement::Kind::Return;
            if (!here(";")) s.expressions.push_back(readExpression());
        } else {
            s.kind = Statement::Kind::Expression;
            s.expressions.push_back(readExpression());
        }
        expect(";");
        return s;
    }

    /// What is declared in it is known in it alone.
    Statement readInner() {
        const std::map<std::string, std::size_t> outside = known_;
        Statement s = readStatement();
        known_ = outside;
        return s;
    }

    Statement readIf() {
        Statement s;
        s.kind = Statement::Kind::If;
        expect("(");
        s.expressions.push_back(readExpression());
        expect(")");
        s.inner.push_back(readInner());
        if (takes("else")) s.inner.push_back(readInner());
        return s;
    }

    Statement readFor() {
        Statement s;
        s.kind = Statement::Kind::For;
        const std::map<std::string, std::size_t> outside = known_;
        expect("(");
        s.inner.push_back(readVariables());
        s.expressions.push_back(readExpression());
        expect(";");
        s.expressions.push_back(readExpression());
        expect(")");
        s.inner.push_back(readInner());
        known_ = outside;
        return s;
    }

    Expression readExpression() {
        Expression first = readAssignment();
        if (!here(",")) return first;
        std::vector<Expression> all{std::move(first)};
        while (takes(",")) all.push_back(readAssignment());
        return made(Expression::Kind::Sequence, std::move(all));
    }

    Expression readAssignment() {
        const Deeper deeper(*this, at_ < tokens_.size() ? tokens_[at_] : last());
        Expression left = readChoice();
        const bool assigns =
            at_ < tokens_.size() && std::ranges::find(kAssignments, tokens_[at_].text) != kAssignments.end();
        if (!assigns) return left;
        const LawToken& sign = tokens_[at_++];
        Expression e = changed(sign, left);
        e.kind = Expression::Kind::Assign;
        e.word = sign.text.substr(0, sign.text.size() - 1);
        e.operands.push_back(readAssignment());
        return e;
    }

    /// Place and parts of what is changed.
    static Expression changed(const LawToken& by, const Expression& variable) {
        if (variable.kind != Expression::Kind::Variable)
            refuseLaw(by, fmt::format("what stands before {} is no variable", by.text), "assign to a variable");
        Expression e;
        e.place = variable.place;
        e.parts = variable.parts;
        return e;
    }

    Expression readChoice() {
        Expression condition = readSigns(0);
        if (!takes("?")) return condition;
        std::vector<Expression> all{std::move(condition)};
        all.push_back(readExpression());
        expect(":");
        all.push_back(readAssignment());
        return made(Expression::Kind::Choice, std::move(all));
    }

    /// The signs of this level and of those that bind more.
    Expression readSigns(std::size_t level) {
        if (level == kSigns.size()) return readPrefix();
        Expression first = readSigns(level + 1);
        const std::vector<std::string_view>& signs = kSigns[level];
        const auto comes = [&] {
            return at_ < tokens_.size() && std::ranges::find(signs, tokens_[at_].text) != signs.end();
        };
        if (!comes()) return first;
        Expression chain;
        chain.kind = here("&&") ? Expression::Kind::And : here("||") ? Expression::Kind::Or : Expression::Kind::Chain;
        chain.operands.push_back(std::move(first));
        while (comes()) {
            chain.signs.push_back(tokens_[at_++].text);
            chain.operands.push_back(readSigns(level + 1));
        }
        return chain;
    }

    Expression readPrefix() {
        const LawToken& t = next("a value");
        const Deeper deeper(*this, t);
        for (const char* sign : {"+", "-", "!", "~"})
            if (t.is(sign)) return made(Expression::Kind::Prefix, {readPrefix()}, t.text);
        if (t.is("++") || t.is("--")) return step(t, readPrefix(), false);
        --at_;
        return readPostfix();
    }

    static Expression step(const LawToken& sign, const Expression& variable, bool after) {
        Expression e = changed(sign, variable);
        e.kind = Expression::Kind::Step;
        e.word = sign.text.substr(0, 1);
        e.after = after;
        return e;
    }

    Expression readPostfix() {
        Expression e = readValue();
        for (;;) {
            if (takes("."))
                e = partsOf(std::move(e), next("a part"));
            else if (here("++") || here("--"))
                e = step(tokens_[at_++], e, true);
            else
                return e;
        }
    }

    static Expression partsOf(Expression whole, const LawToken& named) {
        static const std::map<std::string, int, std::less<>> kFields{
            {"overlap", 0}, {"speed", 1}, {"radius", 2}, {"mass", 3}};
        std::vector<int> parts;
        if (const auto field = kFields.find(named.text); field != kFields.end()) {
            parts = {field->second};
        } else {
            for (const char letter : named.text)
                for (const std::string_view letters : {"xyzw", "rgba", "stpq"})
                    if (const std::size_t k = letters.find(letter); k != std::string_view::npos)
                        parts.push_back(int(k));
            if (parts.size() != named.text.size() || parts.size() > 4)
                refuseLaw(named, fmt::format("there is no part {}", named.text), "take parts by x, y, z, w");
        }
        if (whole.kind == Expression::Kind::Variable) {
            for (int& part : parts)
                if (!whole.parts.empty()) part = whole.parts[std::size_t(part) % whole.parts.size()];
            whole.parts = parts;
            return whole;
        }
        Expression e = made(Expression::Kind::Parts, {});
        e.operands.push_back(std::move(whole));
        e.parts = parts;
        return e;
    }

    Expression readValue() {
        const LawToken& t = next("a value");
        Expression e;
        if (t.is("(")) {
            e = readExpression();
            expect(")");
            return e;
        }
        if (t.kind == LawToken::Kind::Number) {
            e.number = numberOf(t);
            return e;
        }
        if (t.is("true") || t.is("false")) {
            e.number = lawNumber(t.is("true") ? 1 : 0, LawBase::Bool);
            return e;
        }
        if (here("(")) return readCall(t);
        const auto known = known_.find(t.text);
        if (known == known_.end()) refuseLaw(t, fmt::format("{} is not declared", t.text), "declare it before");
        e.kind = Expression::Kind::Variable;
        e.place = known->second;
        return e;
    }

    Expression readCall(const LawToken& t) {
        expect("(");
        Expression e;
        while (!takes(")")) {
            if (takes("void")) continue;
            e.operands.push_back(readAssignment());
            takes(",");
        }
        e.word = t.text;
        e.function = tree_.function(t.text);
        if (e.function != nullptr) {
            e.kind = Expression::Kind::Call;
            if (e.operands.size() != e.function->arguments.size())
                refuseLaw(t, fmt::format("{} takes {} arguments", t.text, e.function->arguments.size()),
                          "give as many");
        } else if (isLawType(t.text) || t.is("Contact")) {
            e.kind = Expression::Kind::Construct;
            e.type = lawTypeOf(t.text);
        } else if (isLawFunction(t.text) && !e.operands.empty() && e.operands.size() <= 3) {
            e.kind = Expression::Kind::Language;
        } else {
            refuseLaw(t, fmt::format("there is no function {} before it", t.text), "define it before it is called");
        }
        return e;
    }

    /// While it lives, expressions are within one more.
    class Deeper {
      public:
        Deeper(Reader& reader, const LawToken& t) : depth_(reader.depth_) {
            constexpr int kMost = 300;
            if (++depth_ > kMost)
                refuseLaw(t, fmt::format("more than {} expressions are within each other", kMost), "use variables");
        }
        ~Deeper() { --depth_; }
        Deeper(const Deeper&) = delete;
        Deeper& operator=(const Deeper&) = delete;

      private:
        int& depth_;
    };

    LawTree tree_;
    std::map<std::string, std::size_t> known_;
    int depth_ = 0;
};

}  // namespace

const LawFunction* LawTree::function(std::string_view name) const {
    for (const std::unique_ptr<LawFunction>& f : functions)
        if (f->name == name) return f.get();
    return nullptr;
}

LawTree lawTree(const std::vector<LawToken>& tokens) {
    return Reader(tokens).read();
}

}  // namespace vkdose
