#include "host/glsl/whole_division.h"

#include <cstddef>
#include <initializer_list>
#include <map>

namespace vkdose {
namespace {

// The numbers of instructions in SPIR-V 1.3, "Instructions".
enum Instruction : std::uint32_t {
    kTypeBool = 20,
    kTypeInt = 21,
    kTypeVector = 23,
    kConstant = 43,
    kConstantComposite = 44,
    kFunction = 54,
    kUDiv = 134,
    kSDiv = 135,
    kUMod = 137,
    kSRem = 138,
    kSMod = 139,
    kLogicalOr = 166,
    kLogicalAnd = 167,
    kSelect = 169,
    kIEqual = 170,
};

constexpr std::size_t kHeader = 5, kBound = 3;  // words; the one with the number of ids

bool divides(std::uint32_t op) {
    return op == kUDiv || op == kSDiv || op == kUMod || op == kSRem || op == kSMod;
}

/// A type of whole numbers.
struct Whole {
    std::uint32_t scalar = 0;  ///< id of its type
    std::uint32_t count = 1;   ///< of a vector's parts
};

/// Constants of one type, and the type of its comparisons.
struct Known {
    std::uint32_t zero, one, minusOne, least, truth;
};

class Guard {
  public:
    explicit Guard(const std::vector<std::uint32_t>& spirv) : words_(spirv), bound_(spirv[kBound]) {}

    std::vector<std::uint32_t> guarded() {
        std::vector<std::uint32_t> head, body;
        bool inFunctions = false;
        for (std::size_t at = kHeader; at < words_.size();) {
            const std::uint32_t length = words_[at] >> 16, op = words_[at] & 0xffff;
            inFunctions = inFunctions || op == kFunction;
            const std::uint32_t* i = &words_[at];
            if (!inFunctions) note(op, i);
            std::vector<std::uint32_t>& to = inFunctions ? body : head;
            if (inFunctions && divides(op) && wholes_.contains(i[1])) {
                const std::uint32_t divisor = safeDivisor(i[1], i[3], i[4], op == kUDiv || op == kUMod, body);
                emit(body, {op, i[1], i[2], i[3], divisor});
            } else {
                to.insert(to.end(), i, i + length);
            }
            at += length;
        }
        std::vector<std::uint32_t> all(words_.begin(), words_.begin() + kHeader);
        all[kBound] = bound_;
        for (const auto* part : {&head, &declared_, &body}) all.insert(all.end(), part->begin(), part->end());
        return all;
    }

  private:
    /// An instruction, its number first.
    static void emit(std::vector<std::uint32_t>& to, std::initializer_list<std::uint32_t> words) {
        to.push_back(std::uint32_t(words.size()) << 16 | *words.begin());
        to.insert(to.end(), words.begin() + 1, words.end());
    }

    void note(std::uint32_t op, const std::uint32_t* i) {
        if (op == kTypeBool) truths_[1] = i[1];
        if (op == kTypeInt && i[2] == 32) wholes_[i[1]] = {i[1], 1};
        if (op != kTypeVector) return;
        if (const auto whole = wholes_.find(i[2]); whole != wholes_.end()) wholes_[i[1]] = {i[2], i[3]};
        if (truths_.contains(1) && i[2] == truths_[1]) truths_[i[3]] = i[1];
    }

    std::uint32_t truthOf(std::uint32_t count) {
        std::uint32_t& one = truths_[1];
        if (one == 0) emit(declared_, {kTypeBool, one = bound_++});
        const std::uint32_t scalar = one;
        std::uint32_t& truth = truths_[count];
        if (truth == 0) emit(declared_, {kTypeVector, truth = bound_++, scalar, count});
        return truth;
    }

    std::uint32_t constant(std::uint32_t type, std::uint32_t value) {
        const Whole& whole = wholes_.at(type);
        const std::uint32_t scalar = bound_++;
        emit(declared_, {kConstant, whole.scalar, scalar, value});
        if (whole.count == 1) return scalar;
        const std::uint32_t vector = bound_++;
        declared_.push_back((3 + whole.count) << 16 | kConstantComposite);
        declared_.insert(declared_.end(), {type, vector});
        declared_.insert(declared_.end(), whole.count, scalar);
        return vector;
    }

    const Known& knownOf(std::uint32_t type) {
        const auto found = known_.find(type);
        if (found != known_.end()) return found->second;
        const std::uint32_t truth = truthOf(wholes_.at(type).count);
        return known_
            .emplace(type, Known{constant(type, 0), constant(type, 1), constant(type, 0xffffffffU),
                                 constant(type, 0x80000000U), truth})
            .first->second;
    }

    /// Writes what chooses the divisor, and gives its id.
    std::uint32_t safeDivisor(std::uint32_t type, std::uint32_t left, std::uint32_t right, bool isUnsigned,
                              std::vector<std::uint32_t>& to) {
        const Known& known = knownOf(type);
        std::uint32_t bad = bound_++;
        emit(to, {kIEqual, known.truth, bad, right, known.zero});
        if (!isUnsigned) {
            const std::uint32_t negates = bound_++, isLeast = bound_++, overflows = bound_++, either = bound_++;
            emit(to, {kIEqual, known.truth, negates, right, known.minusOne});
            emit(to, {kIEqual, known.truth, isLeast, left, known.least});
            emit(to, {kLogicalAnd, known.truth, overflows, negates, isLeast});
            emit(to, {kLogicalOr, known.truth, either, bad, overflows});
            bad = either;
        }
        const std::uint32_t divisor = bound_++;
        emit(to, {kSelect, type, divisor, bad, known.one, right});
        return divisor;
    }

    const std::vector<std::uint32_t>& words_;
    std::uint32_t bound_;
    std::vector<std::uint32_t> declared_;            ///< types and constants, behind those that there are
    std::map<std::uint32_t, Whole> wholes_;          ///< by the id of the type
    std::map<std::uint32_t, std::uint32_t> truths_;  ///< ids of bool and its vectors, by the number of parts
    std::map<std::uint32_t, Known> known_;           ///< by the id of the type
};

}  // namespace

void guardWholeDivisions(std::vector<std::uint32_t>& spirv) {
    spirv = Guard(spirv).guarded();
}

}  // namespace vkdose
