// The tables [[powder]] and [[material]], and the keys that name a powder or a material.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/core/closest_word.h"
#include "host/core/printable.h"
#include "host/model/case_sections.h"
#include "host/model/named_file.h"
#include "host/model/particle_list.h"
#include "host/model/powders.h"
#include "host/model/read_user_law.h"

namespace vkdose {
namespace {

constexpr const char* kNameLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

/// Checks the name of a powder or material (`kind`), which the name of a pair may hold. Adds it to `names`.
void checkName(CaseReader& reader, Section& section, const char* key, const std::string& name, const char* kind,
               std::set<std::string>& names) {
    if (section.has(key) && !section.isString(key)) return;  // already told
    const std::string path = section.path(key);
    if (name.find('-') != std::string::npos)
        reader.fault(path, "has a hyphen, which stands between the two names of a pair, [contact.A-B]",
                     "give letters, digits and _");
    else if (name.empty() || name.size() > 60 || name.find_first_not_of(kNameLetters) != std::string::npos)
        reader.fault(path, fmt::format("is no name of a {}", kind), "give letters, digits and _");
    else if (!names.insert(name).second)
        reader.fault(path, fmt::format("\"{}\" is the name of another {} already", name, kind),
                     fmt::format("give each {} a name of its own", kind));
}

std::vector<std::string> namesOf(const World& world) {
    std::vector<std::string> names;
    for (const Material& m : world.materials) names.push_back(m.name);
    return names;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
    const std::string meant = closestWord(name, known);
    if (!meant.empty()) return fmt::format("did you mean \"{}\"?", meant);
    std::string all;
    for (const std::string& k : known) all += (all.empty() ? "" : ", ") + k;
    return "known: " + all;
}

void readPowder(CaseReader& reader, Section& s, std::set<std::string>& names, std::set<std::string>& materials,
                Case& c) {
    Powder powder;
    powder.name = s.string("name");
    checkName(reader, s, "name", powder.name, "powder", names);
    const std::string material = s.string("material", powder.name);
    if (s.has("material")) {
        checkName(reader, s, "material", material, "material", materials);
    } else if (!materials.insert(material).second && s.isString("name")) {
        reader.fault(s.path("name"), fmt::format("there is a material \"{}\" already", material),
                     "give the powder a `material` of its own too");
    }
    powder.material = static_cast<int>(c.world.materials.size());
    c.world.materials.push_back({material, true, s.has("density") ? s.number("density") : kNaN});
    s.know("density");
    powder.filling.gridGap = c.filling.gridGap;
    if (c.filling.list) {
        for (const char* key : {"mass_g", "size"}) {
            s.know(key);
            if (s.has(key))
                reader.fault(s.path(key), "the particles come from a list, which has them all",
                             "remove it, or give masses and sizes in place of particles.list");
        }
    } else {
        powder.filling.mass = s.number("mass_g");
        powder.filling.size = readSize(reader, s.requiredTable("size"), c);
    }
    c.furtherPowders.push_back(std::move(powder));
}

/// Gives the table of a material its index, and takes the density from it.
void readMaterial(CaseReader& reader, Section& s, std::set<std::string>& names, MaterialTables& tables, Case& c) {
    const std::string name = s.string("name");
    std::vector<Material>& materials = c.world.materials;
    const auto found =
        std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == name; });
    int index = static_cast<int>(found - materials.begin());
    if (index < kUsualMaterials && found != materials.end()) {
        const char* const where[] = {"[contact]", "[contact.wall]", "[contact.coil]"};
        reader.fault(s.path("name"),
                     fmt::format("is the material of the {}, whose moduli stand in {}",
                                 index == kFirstPowder    ? "first powder"
                                 : index == kWallMaterial ? "walls"
                                                          : "coil",
                                 where[index]),
                     "give them there, or another name");
        return s.abandon();
    }
    if (found == materials.end()) {
        checkName(reader, s, "name", name, "material", names);
        materials.push_back({name, false, 0});
        index = static_cast<int>(materials.size()) - 1;
    }
    Material& m = materials[static_cast<std::size_t>(index)];
    if (!tables.emplace(index, &s).second)
        reader.fault(s.path("name"), fmt::format("there is a [[material]] \"{}\" already", name),
                     "join the two tables");
    if (m.powder && s.has("density") && !std::isnan(m.density))
        reader.fault(s.path("density"), "the powder of this material states its density too", "give one of the two");
    if (s.has("density")) m.density = s.number("density");
    s.know("density");
}

/// Name of the first powder, and whether the powders start mixed. A case with one powder need not say either.
void readFirst(CaseReader& reader, Section& root, std::set<std::string>& materials, Case& c) {
    Section& s = root.table("particles");
    const bool further = root.has("powder");
    if (further || root.has("material") || s.has("material")) {
        std::string& name = c.world.materials.front().name;
        name = s.string("material");
        checkName(reader, s, "material", name, "material", materials);
    }
    s.know("material");
    if (further || s.has("mixed")) c.mixed = s.boolean("mixed");
    s.know("mixed");
    if (c.mixed && !further) reader.fault("particles.mixed", "there is only one powder", "add [[powder]]");
    if (c.mixed && c.filling.list)
        reader.fault("particles.mixed", "a list has its particles where they are", "leave it out");
}

}  // namespace

MaterialTables readMaterials(CaseReader& reader, Section& root, Case& c) {
    std::set<std::string> materials{"wall", "coil"};
    readFirst(reader, root, materials, c);
    std::set<std::string> names{c.world.materials.front().name};
    for (Section* s : root.tables("powder")) readPowder(reader, *s, names, materials, c);
    MaterialTables tables;
    for (Section* s : root.tables("material")) readMaterial(reader, *s, materials, tables, c);
    for (std::size_t k = 0; k < c.furtherPowders.size(); ++k) {
        const Material& m = c.world.materials[static_cast<std::size_t>(c.furtherPowders[k].material)];
        const std::string path = fmt::format("powder[{}].density", k);
        const auto table = tables.find(c.furtherPowders[k].material);
        const bool given =
            root.item("powder", k).has("density") || (table != tables.end() && table->second->has("density"));
        if (std::isnan(m.density) && !given)
            reader.fault(path, "is missing", fmt::format("give it, or a density in the [[material]] \"{}\"", m.name));
    }
    if (c.world.materials.size() > std::size_t(kMostMaterials))
        reader.fault(
            root.has("powder") ? "powder" : "material",
            fmt::format("there are {} materials, those of the first powder, of the walls and of the coil among "
                        "them",
                        c.world.materials.size()),
            fmt::format("give at most {}", kMostMaterials));
    return tables;
}

void readList(CaseReader& reader, Section& root, Case& c) {
    if (!c.filling.list) return;
    Section& section = root.table("particles");
    if (!section.isString("list")) return;  // already reported
    const std::filesystem::path file = reader.folderOf("particles.list") / section.node("list")->string;
    if (!requireFile(reader, "particles.list", file, "give the path of a CSV, relative to the case file")) return;
    std::vector<Diagnostic> faults;
    std::vector<ListedPowder> powders;
    for (const PowderOf& p : powdersOf(c)) powders.push_back({p.name, p.material});
    c.filling.list = readParticleList(file, faults, powders, propertiesOfLaw(reader, root));
    c.files.push_back(file);
    section.record("list", std::filesystem::absolute(file).lexically_normal().string());
    for (Diagnostic& fault : faults) reader.add(std::move(fault));
}

int readMaterialName(CaseReader& reader, Section& section, const Case& c, int usual) {
    if (!section.has("material")) {
        section.know("material");
        return usual;
    }
    const std::string name = section.string("material");
    if (!section.isString("material")) return usual;
    const std::vector<std::string> names = namesOf(c.world);
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end())
        reader.fault(section.path("material"), fmt::format("there is no material \"{}\"", printable(name)),
                     suggestion(name, names) + "; a further one needs a [[material]]");
    else if (c.world.materials[index].powder)
        reader.fault(section.path("material"), "is the material of a powder",
                     "add a [[material]] of another name with the same moduli");
    else
        return static_cast<int>(index);
    return usual;
}

std::optional<int> readPowderName(CaseReader& reader, Section& section, const Case& c) {
    if (!section.has("powder")) {
        section.know("powder");
        return {};
    }
    const std::string name = section.string("powder");
    if (!section.isString("powder")) return {};
    std::vector<std::string> names;
    for (const PowderOf& p : powdersOf(c)) {
        if (p.name == name) return p.material;
        names.push_back(p.name);
    }
    reader.fault(section.path("powder"), fmt::format("there is no powder \"{}\"", printable(name)),
                 suggestion(name, names));
    return {};
}

}  // namespace vkdose
