#include "core/cpu.h"

#include <cstdlib>
#include <string_view>

namespace stillwater {

bool has_avx2() {
  static const bool answer = [] {
    const char* wish = std::getenv("STILLWATER_CPU");
    if (wish && std::string_view(wish) == "sse4.2") return false;
#if defined(__x86_64__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");  // all such CPUs have F16C too; Clang 14 can't ask
#else
    return false;
#endif
  }();
  return answer;
}

}  // namespace stillwater
