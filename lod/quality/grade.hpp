#pragma once

#include <string>

#include "base/choice.hpp"
#include "model/certificate.hpp"

namespace springlod::lod {

/// How well a level stands for its base.
enum class Grade { good, fair, rough, faulty };

inline constexpr Choice<Grade> kGrades[] = {
    {Grade::good, "good", "errors of levels that were fitted well"},
    {Grade::fair, "fair", "errors up to about three times those of a good level"},
    {Grade::rough, "rough", "larger errors, as of levels that are only merged"},
    {Grade::faulty, "faulty", "mechanisms, or another mass than the base"}};
constexpr ChoiceTable<Choice<Grade>> choices(Grade) {
  return {"grade", kGrades};
}

/// The grade of a certificate is that of its worst quantity: natural frequencies,
/// velocities after an impact, first period of vibration, local loads, moduli.
Grade grade(const Certificate& certificate);

/// The grade in one line, first the quantities that decided it: "fair: local loads 12 % off (good
/// is up to 8 %); natural frequencies 0.50 % off, first period of vibration 10 % off". Of the
/// moduli, those outside the bound of a good level.
std::string grade_text(const Certificate& certificate);

}  // namespace springlod::lod
