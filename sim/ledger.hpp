#pragma once

namespace springlod {

/// Where the energy is and where it went, at one time [J]. kinetic + elastic + gravity + contact +
/// the losses = the initial sum. Gravity counts from the initial height.
struct LedgerEntry {
  double time = 0;  ///< [s]
  double kinetic = 0;
  double elastic = 0;
  double gravity = 0;       ///< potential
  double contact = 0;       ///< stored in the penalty springs
  double lost_damping = 0;  ///< to spring damping
  double lost_friction = 0;
  double lost_contact = 0;  ///< to contact damping
  double lost_switch = 0;   ///< to a level switch
  double total() const {
    return kinetic + elastic + gravity + contact + lost_damping + lost_friction + lost_contact +
           lost_switch;
  }
};

}  // namespace springlod
