#pragma once
// The keys of a law that a user wrote.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/law/user_law.h"
#include "host/model/case_reader.h"

namespace vkdose {

/// The law of the file that contact.law names, or of the text that a resolved case holds. Null after a fault.
std::shared_ptr<const UserLaw> readUserLaw(CaseReader& reader, Section& contact);

/// The names of the properties that the law of the case gives each particle. Empty without a user's law, and with one
/// at fault, which readUserLaw tells.
std::vector<std::string> propertiesOfLaw(const CaseReader& reader, Section& root);

/// The properties that `section`'s table `properties` gives a material; what it does not state is `usual`, and must be
/// stated if there is none.
LawProperties readProperties(CaseReader& reader, Section& section, const UserLaw& law, const LawProperties* usual);

/// The law's parameters of one class of contacts, from `section`'s table. What that does not state comes from `above`,
/// the class above it; null: all must be stated.
std::array<double, kMostLawParameters> readOwn(CaseReader& reader, Section& section, const UserLaw& law,
                                               const std::array<double, kMostLawParameters>* above);

/// Tells of keys that only a law of the user's own has, in the tables of a case that has none.
void refuseUserLaw(CaseReader& reader, std::span<Section* const> sections);

}  // namespace vkdose
