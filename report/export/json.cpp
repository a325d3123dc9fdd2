#include <nlohmann/json.hpp>

#include "report/export/draft.hpp"
#include "report/export/tetrahedra.hpp"

namespace springlod::report {

namespace {

using Json = nlohmann::ordered_json;

// Three numbers a point, in one list.
Json flat(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) list.push_back(p[axis]);
  return list;
}

Json materials_of(const MassSpringModel& model) {
  Json list = Json::array();
  for (const Material& m : model.materials)
    list.push_back({{"name", m.name},
                    {"young", m.young},
                    {"poisson", m.poisson},
                    {"density", m.density},
                    {"damping", m.damping},
                    {"colour", {m.colour.r, m.colour.g, m.colour.b}}});
  return list;
}

Json binding_of(const Binding& binding) {
  return {{"start", binding.start}, {"node", binding.node}, {"weight", binding.weight}};
}

Json surface_of(const ExportedModel& body) {
  Json triangles = Json::array();
  for (const Triangle& t : body.surface->triangles)
    for (const std::uint32_t corner : t) triangles.push_back(corner);
  return {{"positions", flat(body.surface->positions)},
          {"triangles", std::move(triangles)},
          {"binding", binding_of(body.surface_of_nodes)}};
}

Json springs_of(const MassSpringModel& model) {
  return {{"a", model.a},
          {"b", model.b},
          {"rest_length", model.rest_length},
          {"stiffness", model.stiffness},
          {"damping", model.damping}};
}

Json terms_of(const DilatationTerms& terms) {
  return {{"modulus", terms.modulus},
          {"damping_time", terms.damping_time},
          {"start", terms.start},
          {"node", terms.node},
          {"gradient", flat(terms.gradient)}};
}

Json corners_of(const std::vector<Corner>& corners) {
  Json nodes = Json::array(), young = Json::array();
  for (const Corner& corner : corners) {
    for (const std::uint32_t node : corner.node) nodes.push_back(node);
    young.push_back(corner.young);
  }
  return {{"nodes", std::move(nodes)}, {"young", std::move(young)}};
}

Json tetrahedra_of(const Tetrahedra& tetrahedra) {
  Json nodes = Json::array();
  for (const auto& tetrahedron : tetrahedra.nodes)
    for (const std::uint32_t node : tetrahedron) nodes.push_back(node);
  return {{"nodes", std::move(nodes)},
          {"material", tetrahedra.material},
          {"fraction", tetrahedra.fraction}};
}

Json contact_of(const ContactSurface& contact) {
  return {{"of_nodes", binding_of(contact.of_nodes)},
          {"normal", flat(contact.normal)},
          {"area", contact.area},
          {"stiffness", contact.stiffness}};
}

}  // namespace

ExportDraft draft_json(const ExportedModel& body) {
  const MassSpringModel& model = body.model;
  Json document{{"generator", body.origin},
                {"units", "SI; z is up; nodes count from 0"},
                {"name", body.name},
                {"nodes",
                 {{"rest", flat(model.rest)},
                  {"mass", model.mass},
                  {"volume", model.volume},
                  {"contact_area", model.contact_area},
                  {"border", model.border},
                  {"material", model.material}}},
                {"springs", springs_of(model)},
                {"materials", materials_of(model)}};
  if (!model.dilatation.empty()) document["dilatation_terms"] = terms_of(model.dilatation);
  if (!model.corners.empty()) document["corners"] = corners_of(model.corners);
  if (!model.surface.empty()) document["contact_points"] = contact_of(model.surface);
  if (body.surface) document["surface"] = surface_of(body);
  ExportDraft draft;
  if (const Tetrahedra tetrahedra = tetrahedra_of_cells(model); tetrahedra.empty())
    draft.losses = {no_tetrahedra(model)};
  else
    document["tetrahedra"] = tetrahedra_of(tetrahedra);
  draft.files = {{".json", document.dump() + "\n"}};
  return draft;
}

}  // namespace springlod::report
