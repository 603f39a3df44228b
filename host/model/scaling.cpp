#include "host/model/scaling.h"

#include <fmt/format.h>

#include "host/model/powders.h"

namespace vkdose {

void scaleStress(ContactParameters& p, double s) {
    p.surfaceEnergy *= s;
    p.constantPull *= s * s;
    if (p.law != NormalLaw::Luding) return;  // the others count springs and dashpots in ratios to what moduli give
    for (double ContactParameters::*spring : {&ContactParameters::k1, &ContactParameters::k2Max, &ContactParameters::kc,
                                              &ContactParameters::kt, &ContactParameters::kr, &ContactParameters::kTo})
        p.*spring *= s;
    for (double ContactParameters::*dashpot : {&ContactParameters::gamma, &ContactParameters::gammaT,
                                               &ContactParameters::gammaR, &ContactParameters::gammaTo})
        p.*dashpot *= s * s;
}

double readScaling(CaseReader& reader, Section& contact, NormalLaw law, const Case& c) {
    if (contact.choice("scaling").value_or(0) == 0 || c.filling.list) return 1;
    const double s = c.filling.size.scaleUp;
    for (const PowderOf& powder : powdersOf(c))
        if (powder.filling.size.scaleUp != s)
            reader.fault(powder.path + ".size.scale_up",
                         fmt::format("is {:.6g}, and that of particles.size is {:.6g}: contact.scaling = \"stress\" "
                                     "needs one for all powders",
                                     powder.filling.size.scaleUp, s),
                         "give both the same, or parameters of the spheres and contact.scaling = \"none\"");
    if (law == NormalLaw::User && s != 1)
        reader.fault(contact.path("scaling"),
                     "does not know what the parameters of a law of one's own are, and how they grow with the spheres",
                     "give those of the spheres and \"none\": what is in N/m times scale_up, in N or kg/s times its "
                     "square, in J times its cube; what is in Pa or a ratio as it is");
    return s;
}

}  // namespace vkdose
