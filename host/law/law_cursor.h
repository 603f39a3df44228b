#pragma once
// A walk along the tokens of a user's law.

#include <fmt/format.h>

#include "host/law/law_checks.h"

namespace vkdose {

class LawCursor {
  protected:
    explicit LawCursor(const std::vector<LawToken>& tokens) : tokens_(tokens) {}

    LawToken last() const { return tokens_.empty() ? LawToken{LawToken::Kind::Sign, "", 1, 0} : tokens_.back(); }

    const LawToken& next(const char* wanted) {
        if (at_ >= tokens_.size())
            refuseLaw(last(), fmt::format("the text ends where {} should come", wanted), "add it");
        return tokens_[at_++];
    }
    const LawToken& expect(std::string_view sign) {
        const LawToken& t = next(std::string(sign).c_str());
        if (!t.is(sign)) refuseLaw(t, fmt::format("{} stands where {} should come", t.text, sign), "write it so");
        return t;
    }
    const LawToken& name(const char* of) {
        const LawToken& t = next(of);
        if (t.kind != LawToken::Kind::Name || isLawWord(t.text) || isLawDeclarer(t) || t.is("Contact"))
            refuseLaw(t, fmt::format("{} is no name of {}", t.text, of), "give a name");
        return t;
    }
    bool here(std::string_view word) const { return at_ < tokens_.size() && tokens_[at_].is(word); }

    const std::vector<LawToken>& tokens_;
    std::size_t at_ = 0;
};

}  // namespace vkdose
