// The tables [particles] (but for the place where the powder starts), [[powder]] and [[material]].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/model/case_sections.h"
#include "host/model/named_file.h"
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

/// The mass, or the height of the vessel that it follows from.
void readAmount(CaseReader& reader, Section& particles, Filling& filling) {
    if (!particles.has("fill_height_mm")) {
        particles.know("fill_height_mm");
        filling.mass = particles.number("mass_g");
        return;
    }
    filling.height = particles.number("fill_height_mm");
    particles.forget("fill_height_mm");
    particles.record("mass_g", 0.0);  // keeps its place in the resolved case; findVessel knows it
    const std::string path = particles.path("fill_height_mm");
    if (particles.has("mass_g")) reader.fault(path, "mass_g is given too", "give one of the two");
    if (!particles.has("inside"))
        reader.fault(path, "is the height of a vessel, and no vessel is given", "give particles.inside, or mass_g");
    particles.know("mass_g");
}

void readPowder(CaseReader& reader, Section& s, std::set<std::string>& names, std::set<std::string>& materials,
                PowdersRead& p) {
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
    powder.material = static_cast<int>(p.materials.size());
    p.materials.push_back({material, true, s.has("density") ? s.number("density") : kNaN});
    s.know("density");
    powder.filling.gridGap = p.filling.gridGap;
    if (p.filling.list) {
        for (const char* key : {"mass_g", "size"}) {
            s.know(key);
            if (s.has(key))
                reader.fault(s.path(key), "the particles come from a list, which has them all",
                             "remove it, or give masses and sizes in place of particles.list");
        }
    } else {
        powder.filling.mass = s.number("mass_g");
        powder.filling.size = readSize(reader, s.requiredTable("size"), p.told);
    }
    p.further.push_back(std::move(powder));
}

/// Gives the table of a material its index, and takes the density from it.
void readMaterial(CaseReader& reader, Section& s, std::set<std::string>& names, PowdersRead& p) {
    const std::string name = s.string("name");
    std::vector<Material>& materials = p.materials;
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
    if (!p.tables.emplace(index, &s).second)
        reader.fault(s.path("name"), fmt::format("there is a [[material]] \"{}\" already", name),
                     "join the two tables");
    if (m.powder && s.has("density") && !std::isnan(m.density))
        reader.fault(s.path("density"), "the powder of this material states its density too", "give one of the two");
    if (s.has("density")) m.density = s.number("density");
    s.know("density");
}

/// Name of the first powder, and whether the powders start mixed. A case with one powder need not say either.
void readFirst(CaseReader& reader, Section& root, std::set<std::string>& materials, PowdersRead& p) {
    Section& s = root.table("particles");
    const bool further = root.has("powder");
    if (further || root.has("material") || s.has("material")) {
        std::string& name = p.materials.front().name;
        name = s.string("material");
        checkName(reader, s, "material", name, "material", materials);
    }
    s.know("material");
    if (further || s.has("mixed")) p.mixed = s.boolean("mixed");
    s.know("mixed");
    if (p.mixed && !further) reader.fault("particles.mixed", "there is only one powder", "add [[powder]]");
    if (p.mixed && p.filling.list)
        reader.fault("particles.mixed", "a list has its particles where they are", "leave it out");
}

/// [[powder]] and [[material]], which give the materials their indices.
void readMaterials(CaseReader& reader, Section& root, PowdersRead& p) {
    std::set<std::string> materials{"wall", "coil"};
    readFirst(reader, root, materials, p);
    std::set<std::string> names{p.materials.front().name};
    for (Section* s : root.tables("powder")) readPowder(reader, *s, names, materials, p);
    for (Section* s : root.tables("material")) readMaterial(reader, *s, materials, p);
    for (std::size_t k = 0; k < p.further.size(); ++k) {
        const Material& m = p.materials[static_cast<std::size_t>(p.further[k].material)];
        const std::string path = fmt::format("powder[{}].density", k);
        const auto table = p.tables.find(p.further[k].material);
        const bool given =
            root.item("powder", k).has("density") || (table != p.tables.end() && table->second->has("density"));
        if (std::isnan(m.density) && !given)
            reader.fault(path, "is missing", fmt::format("give it, or a density in the [[material]] \"{}\"", m.name));
    }
    if (p.materials.size() > std::size_t(kMostMaterials))
        reader.fault(
            root.has("powder") ? "powder" : "material",
            fmt::format("there are {} materials, those of the first powder, of the walls and of the coil among "
                        "them",
                        p.materials.size()),
            fmt::format("give at most {}", kMostMaterials));
}

/// The file of particles.list, whose powders have names by now.
void readList(CaseReader& reader, Section& root, PowdersRead& p) {
    Section& section = root.table("particles");
    if (!section.isString("list")) return;  // already reported
    const std::filesystem::path file = reader.folderOf("particles.list") / section.node("list")->string;
    if (!requireFile(reader, "particles.list", file, "give the path of a CSV, relative to the case file")) return;
    std::vector<Diagnostic> faults;
    p.filling.list = readParticleList(file, faults, p.named(), propertiesOfLaw(reader, root));
    p.told.files.push_back(file);
    section.record("list", std::filesystem::absolute(file).lexically_normal().string());
    for (Diagnostic& fault : faults) reader.add(std::move(fault));
}

/// [particles], but for names.
void readParticles(CaseReader& reader, Section& root, PowdersRead& p) {
    Section& section = root.requiredTable("particles");
    p.materials.front().density = section.number("density");
    if (section.has("list")) {
        if (section.has("mass_g"))
            reader.fault("particles.mass_g", "a list of particles has its own mass", "give mass_g or list, not both");
        section.know("mass_g");
        section.know("fill_height_mm");
        p.filling.list.emplace();
        (void)section.string("list");
        return;
    }
    section.know("list");
    readAmount(reader, section, p.filling);
    p.filling.gridGap = section.number("grid_gap");
    p.filling.size = readSize(reader, section.requiredTable("size"), p.told);
}

}  // namespace

std::vector<ListedPowder> PowdersRead::named() const {
    std::vector<ListedPowder> all{{materials.front().name, kFirstPowder}};
    for (const Powder& powder : further) all.push_back({powder.name, powder.material});
    return all;
}

PowdersRead readPowders(CaseReader& reader, Section& root) {
    PowdersRead powders;
    readParticles(reader, root, powders);
    readMaterials(reader, root, powders);
    if (powders.filling.list) readList(reader, root, powders);
    return powders;
}

}  // namespace vkdose
