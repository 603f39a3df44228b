#include "host/law/law_program.h"

#include <algorithm>

namespace vkdose {
namespace {

LawTree treeOf(const UserLaw& law) {
    std::string bare;
    std::vector<LawFault> faults;  // a law that was read has none
    return lawTree(lawTokens(law.text, bare, faults));
}

/// These elements of a value, or all of it.
LawValue taken(const LawValue& from, const std::vector<int>& parts) {
    if (parts.empty()) return from;
    LawValue v;
    v.type = {from.type.base, std::uint8_t(parts.size()), 1};
    for (std::size_t k = 0; k < parts.size(); ++k) v.x[k] = from[std::size_t(parts[k])];
    return v;
}

}  // namespace

LawProgram::LawProgram(const UserLaw& law)
    : tree_(treeOf(law)),
      force_(tree_.function("force")),
      stiffness_(tree_.function("stiffness")),
      damping_(tree_.function("damping")),
      pull_(tree_.function("pull")),
      energy_(tree_.function("energy")),
      reach_(tree_.function("reach")),
      variables_(tree_.places) {
    for (const LawStatement& constant : tree_.constants) run(constant);
    for (const std::string& property : law.properties)
        flows_.push_back(tree_.function(std::string(kLawFlow) + property));
}

void LawProgram::begin(const Parameters& parameters, const Memory& memory, const LawSides& sides) {
    for (std::size_t k = 0; k < tree_.parameters.size(); ++k)
        variables_[tree_.parameters[k]] = lawNumber(parameters[k]);
    for (std::size_t k = 0; k < tree_.memories.size(); ++k) variables_[tree_.memories[k]] = lawNumber(memory[k]);
    for (std::size_t k = 0; k < tree_.properties.size(); ++k) {
        LawValue& both = variables_[tree_.properties[k]];
        both.type = lawTypeOf("vec2");
        both.x[0] = sides.i[k];
        both.x[1] = sides.j[k];
    }
}

LawAnswer LawProgram::answer(const Parameters& parameters, const LawContact& contact, Memory& memory,
                             const LawSides& sides) {
    begin(parameters, memory, sides);
    LawAnswer answer;
    answer.force = call(force_, contact);
    for (std::size_t k = 0; k < tree_.memories.size(); ++k) memory[k] = variables_[tree_.memories[k]][0];
    answer.stiffness = call(stiffness_, contact);
    answer.damping = call(damping_, contact);
    answer.pull = call(pull_, contact);
    answer.energy = call(energy_, contact);
    for (std::size_t k = 0; k < flows_.size(); ++k) answer.flows[k] = call(flows_[k], contact);
    return answer;
}

double LawProgram::reach(const Parameters& parameters, double radius) {
    begin(parameters, {}, {});
    return call(reach_, {0, 0, radius, 0});
}

/// 0 of a function that the law does not have.
double LawProgram::call(const LawFunction* function, const LawContact& contact) {
    if (function == nullptr) return 0;
    LawValue c;
    c.type = lawTypeOf("Contact");
    std::copy_n(std::array{contact.overlap, contact.speed, contact.radius, contact.mass}.begin(), 4, c.x.begin());
    return call(*function, std::span(&c, 1))[0];
}

LawValue LawProgram::call(const LawFunction& function, std::span<const LawValue> arguments) {
    for (std::size_t k = 0; k < arguments.size(); ++k)
        variables_[function.arguments[k]] = converted(arguments[k], function.argumentTypes[k]);
    returned_ = {};
    run(function.body);
    return converted(returned_, function.type);
}

std::vector<LawValue> LawProgram::operandsOf(const LawExpression& e) {
    std::vector<LawValue> values;
    values.reserve(e.operands.size());
    for (const LawExpression& operand : e.operands) values.push_back(value(operand));
    return values;
}

LawValue LawProgram::value(const LawExpression& e) {
    using Kind = LawExpression::Kind;
    ++work_;
    switch (e.kind) {
        case Kind::Number:
            return e.number;
        case Kind::Variable:
            return taken(variables_[e.place], e.parts);
        case Kind::Parts:
            return taken(value(e.operands[0]), e.parts);
        case Kind::Prefix:
            return turnedBy(e.word, value(e.operands[0]));
        case Kind::Chain: {
            LawValue sum = value(e.operands[0]);
            for (std::size_t k = 1; k < e.operands.size(); ++k)
                sum = combined(e.signs[k - 1], sum, value(e.operands[k]));
            return sum;
        }
        case Kind::And:
        case Kind::Or: {
            bool is = false;
            for (const LawExpression& operand : e.operands) {
                is = value(operand).isTrue();
                if (is == (e.kind == Kind::Or)) break;
            }
            return lawNumber(is ? 1 : 0, LawBase::Bool);
        }
        case Kind::Choice:
            return value(e.operands[value(e.operands[0]).isTrue() ? 1 : 2]);
        case Kind::Sequence:
            return operandsOf(e).back();
        case Kind::Assign: {
            const LawValue by = value(e.operands[0]);
            return assigned(e, e.word.empty() ? by : combined(e.word, taken(variables_[e.place], e.parts), by));
        }
        case Kind::Step:
            return stepped(e);
        case Kind::Call:
            return call(*e.function, operandsOf(e));
        case Kind::Language:
            return lawFunction(e.word, operandsOf(e));
        case Kind::Construct:
            return constructed(e.type, operandsOf(e));
    }
    return {};
}

LawValue LawProgram::assigned(const LawExpression& e, const LawValue& to) {
    LawValue& variable = variables_[e.place];
    if (e.parts.empty()) {
        variable = converted(to, variable.type);
        return variable;
    }
    const LawValue values = converted(to, {variable.type.base, std::uint8_t(e.parts.size()), 1});
    for (std::size_t k = 0; k < e.parts.size(); ++k) variable.x[std::size_t(e.parts[k])] = values[k];
    return values;
}

LawValue LawProgram::stepped(const LawExpression& e) {
    const LawValue before = taken(variables_[e.place], e.parts);
    const LawValue now = assigned(e, combined(e.word, before, lawNumber(1, before.type.base)));
    return e.after ? before : now;
}

LawProgram::Flow LawProgram::run(const LawStatement& s) {
    using Kind = LawStatement::Kind;
    switch (s.kind) {
        case Kind::Expression:
            value(s.expressions[0]);
            return Flow::On;
        case Kind::Declare:
            variables_[s.place] = converted(value(s.expressions[0]), s.type);
            return Flow::On;
        case Kind::If:
            if (value(s.expressions[0]).isTrue()) return run(s.inner[0]);
            return s.inner.size() > 1 ? run(s.inner[1]) : Flow::On;
        case Kind::For:
            return runLoop(s);
        case Kind::Return:
            returned_ = s.expressions.empty() ? LawValue{} : value(s.expressions[0]);
            return Flow::Return;
        case Kind::Break:
            return Flow::Break;
        case Kind::Continue:
            return Flow::Continue;
        case Kind::Block:
            for (const LawStatement& inner : s.inner)
                if (const Flow flow = run(inner); flow != Flow::On) return flow;
            return Flow::On;
    }
    return Flow::On;
}

LawProgram::Flow LawProgram::runLoop(const LawStatement& s) {
    for (run(s.inner[0]); value(s.expressions[0]).isTrue(); value(s.expressions[1])) {
        const Flow flow = run(s.inner[1]);
        if (flow == Flow::Break) break;
        if (flow == Flow::Return) return flow;
    }
    return Flow::On;
}

}  // namespace vkdose
