#include <algorithm>

#include <catch2/catch.hpp>

#include "base/file.hpp"
#include "elastic/stable_step.hpp"
#include "report/export/draft.hpp"
#include "report/export/explicit_step.hpp"
#include "report/export/export.hpp"
#include "report/export/numpy.hpp"
#include "report/export/zip.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

MassSpringModel soft_block(double poisson) {
  Material soft = material("so\"ft & <wet>", 2e5, 900, 0.001);
  soft.poisson = poisson;
  return block(3, 2, 2, 0.1, soft, voxelize::LatticeStyle::corners);
}

ExportDraft draft_of(ModelFormat format, const MassSpringModel& model) {
  return choice_of(format).write({.model = model, .name = "body", .origin = "a test"});
}

std::string all_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace

TEST_CASE("each format writes a main file with its ending, twice the same, and its losses") {
  const ModelFormat format = GENERATE(from_range(all_choices<ModelFormat>()));
  CAPTURE(to_string(format));
  const MassSpringModel model = soft_block(0.4);
  const ExportDraft draft = draft_of(format, model);
  REQUIRE_FALSE(draft.files.empty());
  CHECK(draft.files.front().ending.front() == '.');  // so that -o may give it
  for (std::size_t f = 0; f < draft.files.size(); ++f) {
    CHECK(draft.files[f].content.size() > 100);
    CHECK(draft_of(format, model).files[f].content == draft.files[f].content);
  }
  // Those two hold all of a level.
  const bool whole = format == ModelFormat::json || format == ModelFormat::npz;
  CHECK(draft.losses.empty() == whole);
}

TEST_CASE("formats say that a level without cells has no tetrahedra") {
  const ModelFormat format = GENERATE(ModelFormat::newton, ModelFormat::sofa, ModelFormat::msh,
                                      ModelFormat::vtk, ModelFormat::npz, ModelFormat::json);
  CAPTURE(to_string(format));
  const ExportDraft with = draft_of(format, soft_block(0.25));
  CHECK_THAT(all_of(with.losses),
             !Contains("tetrahedra: the level has") && !Contains("tetrahedra: only"));
  const ExportDraft without = draft_of(format, rods());
  CHECK_THAT(all_of(without.losses), Contains("tetrahedra: only the base"));
  CHECK(without.files.size() == (format == ModelFormat::newton ? 2 : 1));
}

TEST_CASE("the step of an export is that of the springs alone") {
  const MassSpringModel plain = soft_block(0.25);
  CHECK(explicit_step(plain) == Approx(0.8 * elastic::stable_step(plain)));
  const MassSpringModel dilating = soft_block(0.45);
  REQUIRE_FALSE(dilating.dilatation.empty());
  MassSpringModel springs = dilating;
  springs.dilatation = {};
  CHECK(explicit_step(dilating) == Approx(0.8 * elastic::stable_step(springs)));
  CHECK(explicit_step(dilating) > 0.8 * elastic::stable_step(dilating));
  CHECK_THAT(draft_of(ModelFormat::newton, dilating).settings.front(), Contains("step: at most"));
  CHECK_THAT(all_of(draft_of(ModelFormat::newton, dilating).losses), Contains("dilatation terms"));
}

TEST_CASE("an export without springs has no step") {
  MassSpringModel lone;
  lone.rest = {Vec3(1, 2, 3)};
  lone.mass = lone.volume = {1};
  lone.contact_area = {0};
  lone.border = {1};
  lone.material = {0};
  lone.materials = {material("alone", 1e6, 1000, 0)};
  for (const ModelFormat format : all_choices<ModelFormat>()) {
    CAPTURE(to_string(format));
    CHECK_NOTHROW(draft_of(format, lone));
  }
  CHECK_THAT(explicit_step_line(lone, explicit_step(lone)), Contains("there are no springs"));
}

TEST_CASE("names of materials cannot break a file") {
  const MassSpringModel model = soft_block(0.25);
  CHECK_THAT(draft_of(ModelFormat::msh, model).files.back().content,
             Contains("3 1 \"so_ft & <wet>\"\n"));
  CHECK_THAT(draft_of(ModelFormat::usda, model).files.front().content,
             Contains("[\"so\\\"ft & <wet>\"]"));
  CHECK_THAT(draft_of(ModelFormat::sofa, model).files.back().content,
             Contains("<Node name=\"so_ft____wet__0\">"));
}

TEST_CASE("a zip archive has the entries and checksums of its specification") {
  const std::string archive = zip_archive({{"a.txt", "123456789"}, {"b", ""}});
  CHECK(archive.substr(0, 4) == "PK\x03\x04");
  // The check value of CRC-32.
  CHECK(archive.substr(14, 4) == "\x26\x39\xf4\xcb");
  CHECK(archive.substr(archive.size() - 22, 4) == "PK\x05\x06");
  CHECK(archive[archive.size() - 22 + 10] == 2);  // entries
  CHECK(zip_archive({}).size() == 22);
}

TEST_CASE("export adds the ending of the format and writes further files beside") {
  const TemporaryFolder folder;
  const MassSpringModel model = soft_block(0.25);
  const ExportedModel body{.model = model, .name = "body", .origin = "a test"};
  const ExportReport written = export_model(body, ModelFormat::vtk, folder / "block.vtu");
  REQUIRE(written.files.size() == 2);
  CHECK(written.files[0] == folder / "block.vtu");
  CHECK(written.files[1] == folder / "block-tetrahedra.vtu");
  CHECK(export_model(body, ModelFormat::newton, folder / "block").files ==
        std::vector<std::filesystem::path>{folder / "block.npz", folder / "block.py"});
  CHECK_THAT(read_file(folder / "block.py"), Contains("def build("));
}
