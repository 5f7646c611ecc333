#pragma once

#include <type_traits>

namespace gpu_shading::energyplus {

// How a function returns its result: in an integer register (also nothing, an address, or an object
// whose address the caller passes), or in a floating-point register.
enum class Result { integer, real };

template <typename Type>
constexpr Result result_of() {
  if constexpr (!std::is_void_v<Type> && !std::is_pointer_v<Type> &&
                std::is_trivially_copyable_v<Type>) {
    static_assert(sizeof(Type) <= sizeof(void*), "only the first register of a result is returned");
  }
  return std::is_floating_point_v<Type> ? Result::real : Result::integer;
}

// The address of code that calls `function` with the stack aligned, and leaves every register as it
// was, except that of the result. A caller in the same library may rely on what it knows of a
// function: which registers it does not change although the System V ABI lets it (GCC's -fipa-ra),
// and that it needs no aligned stack (-fipa-stack-alignment). Only the lower half of AVX registers
// is kept: a library that is built without AVX holds nothing in the upper half. At most eight
// arguments may be on the stack, of a word each. Exceptions pass. The code is never freed. Throws
// Error if there are too many.
void* preserve_registers(void* function, Result result);

}  // namespace gpu_shading::energyplus
