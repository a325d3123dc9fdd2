#include "report/export/draft.hpp"
#include "report/export/numpy.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {
namespace {

// A member of all materials as an array.
template <class T>
std::vector<T> each(const std::vector<Material>& materials, T Material::*member) {
  std::vector<T> values;
  for (const Material& material : materials) values.push_back(material.*member);
  return values;
}

// Rows of `columns` values, one after the other.
template <class Rows>
std::vector<std::uint32_t> flat(const Rows& rows) {
  std::vector<std::uint32_t> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

void add_binding(NumpyArrays& arrays, const std::string& name, const Binding& binding) {
  arrays.add(name + "_start", binding.start);
  arrays.add(name + "_node", binding.node);
  arrays.add(name + "_weight", binding.weight);
}

void add_springs(NumpyArrays& arrays, const MassSpringModel& model) {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    ends.push_back(model.a[s]);
    ends.push_back(model.b[s]);
  }
  arrays.add("springs", ends, 2);
  arrays.add("rest_length", model.rest_length);
  arrays.add("stiffness", model.stiffness);
  arrays.add("damping", model.damping);
}

void add_materials(NumpyArrays& arrays, const std::vector<Material>& materials) {
  arrays.add("material_name", each(materials, &Material::name));
  arrays.add("material_young", each(materials, &Material::young));
  arrays.add("material_poisson", each(materials, &Material::poisson));
  arrays.add("material_density", each(materials, &Material::density));
  arrays.add("material_damping", each(materials, &Material::damping));
}

void add_terms(NumpyArrays& arrays, const DilatationTerms& terms) {
  arrays.add("term_modulus", terms.modulus);
  arrays.add("term_damping_time", terms.damping_time);
  arrays.add("term_start", terms.start);
  arrays.add("term_node", terms.node);
  arrays.add("term_gradient", terms.gradient);
}

void add_corners(NumpyArrays& arrays, const std::vector<Corner>& corners) {
  std::vector<std::uint32_t> nodes;
  std::vector<double> young;
  for (const Corner& corner : corners) {
    nodes.insert(nodes.end(), corner.node.begin(), corner.node.end());
    young.push_back(corner.young);
  }
  arrays.add("corner_node", nodes, 4);
  arrays.add("corner_young", young);
}

void add_contact(NumpyArrays& arrays, const ContactSurface& contact) {
  add_binding(arrays, "contact_point", contact.of_nodes);
  arrays.add("contact_point_normal", contact.normal);
  arrays.add("contact_point_area", contact.area);
  arrays.add("contact_point_stiffness", contact.stiffness);
}

void add_tetrahedra(NumpyArrays& arrays, const MassSpringModel& model, const Tetrahedra& cells) {
  arrays.add("tetrahedra", flat(cells.nodes), 4);
  arrays.add("tetrahedron_material", cells.material);
  arrays.add("tetrahedron_young", young_of(model, cells));
  arrays.add("tetrahedron_poisson", poisson_of(model, cells));
  arrays.add("tetrahedron_density", density_of(model, cells));
}

}  // namespace

ExportDraft draft_npz(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  NumpyArrays arrays;
  arrays.add("origin", std::vector<std::string>{body.origin});
  arrays.add("rest", model.rest);
  arrays.add("mass", model.mass);
  arrays.add("volume", model.volume);
  arrays.add("contact_area", model.contact_area);
  arrays.add("border", model.border);
  arrays.add("material", model.material);
  add_springs(arrays, model);
  add_materials(arrays, model.materials);
  if (!model.dilatation.empty()) add_terms(arrays, model.dilatation);
  if (!model.corners.empty()) add_corners(arrays, model.corners);
  if (!model.surface.empty()) add_contact(arrays, model.surface);
  if (body.surface) {
    arrays.add("surface_rest", surface_points(body));
    arrays.add("surface_triangles", flat(body.surface->triangles), 3);
    add_binding(arrays, "surface", body.surface_of_nodes);
  }
  ExportDraft draft;
  const Tetrahedra cells = tetrahedra_of_cells(model);
  if (cells.empty())
    draft.losses = {no_tetrahedra(model)};
  else
    add_tetrahedra(arrays, model, cells);
  draft.files = {{".npz", arrays.file()}};
  return draft;
}

}  // namespace springlod::report
