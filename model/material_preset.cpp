#include "model/material_preset.hpp"

namespace springlod::inline model {
namespace {

// Rubbers, silicones, gels and flesh have Poisson's ratios of 0.499 and more.
constexpr double kNearlyIncompressible = 0.495;
// Middle of the published range of foams, 0.1 to 0.4.
constexpr double kFoam = 0.25;

constexpr const char* kAshbyRubber =
    "Ashby, Materials Selection in Mechanical Design, appendix A: 1.5 to 2.5 MPa";
constexpr const char* kDowling = "Dowling, Mechanical Behavior of Materials, table 5.2";

using Row = MaterialPresetChoice;
constexpr Row row(MaterialPreset preset, const char* name, const char* help, double young,
                  double poisson, double density, const char* source) {
  return {{preset, name, help}, young, poisson, density, source};
}

constexpr Row kRows[] = {
    row(MaterialPreset::natural_rubber, "natural_rubber", "natural rubber without filler", 1.9e6,
        kNearlyIncompressible, 925, kAshbyRubber),
    row(MaterialPreset::butyl_rubber, "butyl_rubber", "butyl rubber", 1.4e6, kNearlyIncompressible,
        910, "Ashby, Materials Selection in Mechanical Design, appendix A: 1 to 2 MPa"),
    row(MaterialPreset::neoprene, "neoprene", "neoprene (chloroprene rubber)", 1.2e6,
        kNearlyIncompressible, 1230,
        "Ashby, Materials Selection in Mechanical Design, appendix A: 0.7 to 2 MPa"),
    row(MaterialPreset::ecoflex_00_30, "ecoflex_00_30", "silicone rubber Ecoflex 00-30", 97e3,
        kNearlyIncompressible, 1070,
        "Dawood et al., Phantom Material Database, Advanced Healthcare Materials 2024: in "
        "compression; other sources 43 to 118 kPa"),
    row(MaterialPreset::dragon_skin_30, "dragon_skin_30", "silicone rubber Dragon Skin 30", 590e3,
        kNearlyIncompressible, 1080, "Smooth-On data sheet: modulus at 100 % strain, 86 psi"),
    row(MaterialPreset::pdms, "pdms", "silicone rubber Sylgard 184, base and agent 10 to 1", 2.0e6,
        kNearlyIncompressible, 1030,
        "Wang, Volinsky and Gallant, Journal of Applied Polymer Science 131:41050, 2014"),
    // Without filler, so of the density of the polymer: 970 kg/m3.
    row(MaterialPreset::silicone_gel, "silicone_gel", "silicone gel Sylgard 527", 5e3,
        kNearlyIncompressible, 970,
        "Palchesko et al., PLoS ONE 7:e51499, 2012: the softest of its blends with Sylgard 184"),
    // Water with 4.8 % by mass of collagen, of some 1350 kg/m3.
    row(MaterialPreset::gelatin, "gelatin", "gelatin, one part of powder in 20 of water", 4.34e3,
        kNearlyIncompressible, 1010,
        "Bonavia, Viscoelastic Material Properties of Gelatin, arXiv:2512.20502, 2025: in "
        "compression, instantaneous, 4.34 (0.64) kPa; 277 kPa at one part in 2"),
    row(MaterialPreset::cork, "cork", "cork", 25.5e6, 0, 170,
        "Ashby, Materials Selection in Mechanical Design, appendix A: 13 to 50 MPa"),
    row(MaterialPreset::flexible_foam, "flexible_foam", "flexible polymer foam of low density",
        1.7e6, kFoam, 52,
        "Ashby, Materials Selection in Mechanical Design, appendix A: 1 to 3 MPa"),
    row(MaterialPreset::rigid_foam, "rigid_foam", "rigid polymer foam of low density", 43e6, kFoam,
        50, "Ashby, Materials Selection in Mechanical Design, appendix A: 23 to 80 MPa"),
    row(MaterialPreset::liver, "liver", "healthy human liver", 4.1e3, kNearlyIncompressible, 1060,
        "Fung et al., PLoS ONE 8:e85067, 2013: by elastography, 2.3 to 5.9 kPa"),
    row(MaterialPreset::fat, "fat", "adipose tissue of the breast", 3.0e3, 0.49, 940,
        "Briot et al., Clinical Biomechanics 2022: in vivo, 3.0 (1.2) kPa"),
    row(MaterialPreset::muscle, "muscle", "skeletal muscle at rest", 11.1e3, kNearlyIncompressible,
        1060,
        "Arda et al., American Journal of Roentgenology 197:532, 2011: gastrocnemius in vivo, 11.1 "
        "(4.1) kPa"),
    row(MaterialPreset::hdpe, "hdpe", "high-density polyethylene", 1.08e9, 0.42, 950, kDowling),
    row(MaterialPreset::nylon, "nylon", "nylon 66, dry", 2.7e9, 0.41, 1140, kDowling),
    row(MaterialPreset::pmma, "pmma", "acrylic glass", 2.7e9, 0.35, 1190, kDowling),
    row(MaterialPreset::abs, "abs", "ABS plastic of medium impact strength", 2.4e9, 0.35, 1050,
        kDowling),
    row(MaterialPreset::aluminium, "aluminium", "aluminium", 70.3e9, 0.345, 2700, kDowling),
    row(MaterialPreset::steel, "steel", "mild steel", 212e9, 0.293, 7850, kDowling),
};

}  // namespace

ChoiceTable<MaterialPresetChoice> choices(MaterialPreset) {
  return {"preset", kRows};
}

void apply(MaterialPreset preset, Material& material) {
  const MaterialPresetChoice& of = choice_of(preset);
  material.young = of.young;
  material.poisson = of.poisson;
  material.density = of.density;
}

}  // namespace springlod::inline model
