#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/material.hpp"
#include "report/labelled_run.hpp"
#include "sim/study/compare.hpp"

namespace springlod::report {

/// The runs of one chain.
struct ComparedChain {
  const LodAsset& asset;
  const sim::Comparison& comparison;
};

/// A run as a panel of a film shows it. What it refers to must outlive it.
struct FilmedRun {
  std::string label;
  std::string title;                  ///< with the numbers of nodes and springs
  std::vector<std::string> captions;  ///< below the title
  const sim::Scenario& scenario;
  const MassSpringModel& model;  ///< whose nodes and springs are drawn
  const std::vector<sim::Frame>& frames;
  const std::vector<std::uint32_t>& anchored;  ///< nodes of `model`
  /// What the camera frames and the surface is bound to: the model itself or, of a level in a
  /// comparison, its base, to which the motion is mapped.
  const MassSpringModel& body;
  const std::vector<sim::Frame>& body_frames;
  const TriangleMesh* surface = nullptr;  ///< may be null
  Binding surface_of_body = {};
  std::vector<Colour> part_colours = {};  ///< of the parts of the surface

  /// Of the last frame [s].
  double end() const { return frames.back().time; }
};

/// The base of the first chain and the levels of all. `levels`: those to show, 0 for the base;
/// empty: all. Throws InputError for comparisons without runs or frames, or of another asset.
std::vector<FilmedRun> filmed_runs(const std::vector<ComparedChain>& chains,
                                   const std::vector<std::uint32_t>& levels);

/// Throws InputError for a run without frames.
std::vector<FilmedRun> filmed_runs(const std::vector<LabelledRun>& runs);

}  // namespace springlod::report
