#include "sim/fast/vector_target.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fast/vector_target.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for every target.
#include <hwy/highway.h>

#include "sim/fast/add_product-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace springlod::sim::HWY_NAMESPACE {

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}
bool target_fuses() {
  return kFuses;
}

}  // namespace springlod::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace springlod::sim {

HWY_EXPORT(target_name);
HWY_EXPORT(target_fuses);

const char* vector_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

bool fuses_products() {
  return HWY_DYNAMIC_DISPATCH(target_fuses)();
}

void use_portable_kernels() {
#if HWY_ARCH_X86
  hwy::DisableTargets(HWY_SSE4 - 1);  // newer instruction sets have lower bits
#endif
}

}  // namespace springlod::sim
#endif
