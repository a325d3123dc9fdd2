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

/// The grade of a certificate is that of its worst quantity: frequencies, blows, first period,
/// local loads, moduli.
Grade grade(const Certificate& certificate);

/// The grade and its reasons in one line: "good: frequencies 0.5 %, blows 0 %, first period 10 %,
/// local loads 3 %". Materials whose Young's modulus is outside the bound of a good level are
/// named.
std::string grade_text(const Certificate& certificate);

}  // namespace springlod::lod
