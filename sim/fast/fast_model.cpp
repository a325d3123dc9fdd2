#include "sim/fast/fast_model.hpp"

#include <optional>
#include <utility>

#include "sim/fast/look/row_corners.hpp"
#include "sim/fast/quads/quad_body.hpp"
#include "sim/fast/rows/row_body.hpp"
#include "sim/fast/step_time.hpp"

namespace springlod::sim {
namespace {

// If rows have fewer springs than this on average, quads are faster [springs of eight]: a row takes
// as long as about 3.5 springs in quads (bench_step).
constexpr std::uint64_t kLeastFill = 4;

template <class Layout, class Body>
class Laid final : public FastModel {
 public:
  explicit Laid(Layout layout) : layout_(std::move(layout)) {}
  std::unique_ptr<FastBody> new_body(bool with_damping) const override {
    return std::make_unique<Body>(layout_, with_damping);
  }

 private:
  Layout layout_;
};

template <class Real>
bool fills_rows(const MassSpringModel& model, const RowLayout<Real>& rows) {
  return model.spring_count() >= kLeastFill * rows.rows.size() &&
         model.dilatation.count() >= kLeastFill * rows.dilatation.rows.size();
}

/// Rows, if the model has what they take and fills them.
template <class Real>
std::optional<RowLayout<Real>> filled_rows(const MassSpringModel& model) {
  if (!has_terms_of_cells(model)) return std::nullopt;
  RowLayout<Real> rows = make_row_layout<Real>(model);
  return fills_rows(model, rows) ? std::optional(std::move(rows)) : std::nullopt;
}

template <class Real>
std::unique_ptr<FastModel> lay_out(const MassSpringModel& model, Layout layout) {
  if (layout == Layout::fastest) {
    if (auto rows = filled_rows<Real>(model)) {
      rows->corners = place_corners(model, *rows);
      return std::make_unique<Laid<RowLayout<Real>, RowBody<Real>>>(*std::move(rows));
    }
  }
  return std::make_unique<Laid<QuadLayout<Real>, QuadBody<Real>>>(make_quad_layout<Real>(model));
}

template <class Real>
StepWork work_of(const RowLayout<Real>& layout) {
  StepWork work{.kernel = Kernel::rows, .eights = layout.rows.size()};
  for (const RowBlock& block : layout.blocks) work.nodes += block.places() + block.reach;
  return work;
}

template <class Real>
StepWork work_of(const QuadLayout<Real>& layout) {
  StepWork work{.kernel = Kernel::quads};
  for (const QuadBlock<Real>& block : layout.blocks) {
    work.eights += block.pairs.size();
    work.nodes += block.nowhere();
  }
  return work;
}

template <class Real>
StepWork fastest_work(const MassSpringModel& model) {
  const auto rows = filled_rows<Real>(model);
  return rows ? work_of(*rows) : work_of(make_quad_layout<Real>(model));
}

}  // namespace

std::unique_ptr<FastModel> make_fast_model(const MassSpringModel& model, Precision precision,
                                           Layout layout) {
  return precision == Precision::single_precision ? lay_out<float>(model, layout)
                                                  : lay_out<double>(model, layout);
}

StepWork step_work(const MassSpringModel& model, Precision precision) {
  return precision == Precision::single_precision ? fastest_work<float>(model)
                                                  : fastest_work<double>(model);
}

}  // namespace springlod::sim
