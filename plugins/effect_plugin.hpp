#pragma once
/// For authors of effects. A module consists of classes derived from EffectOf (transmission/effect.h) and one function:
///
///   extern "C" const halyard_effect_table* halyard_effects() {
///     static const auto table = halyard::effect_table<MyEffect, MyOtherEffect>();
///     return &table;
///   }
///
/// `halyard COMMAND --effects MODULE.so` adds the effects to the library. Model files, scenario files and sweeps can
/// then name them, and the diagnosis tries them at every joint that can have them. An effect that also derives from
/// RefinesSearch (diagnosis/search_space.h) states how the diagnosis searches for its parameters.
///
/// Unlike an estimator, an effect is called inside the equations, over double, Dual and Lanes, so C++ types cross the
/// boundary. The table therefore states the module's compiler and the sizes of these types. The host checks both before
/// it uses anything else of the module.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/search_space.h"
#include "transmission/effect.h"

/// Increases when anything that crosses the boundary changes its meaning or place.
#define HALYARD_EFFECT_INTERFACE 5

/// The first two members may be read for any version; `compiler` and `layout` may be read only if the version matches.
/// The host checks all four before it calls make.
struct halyard_effect_table {
  std::uint32_t interface_version;  ///< HALYARD_EFFECT_INTERFACE of the headers that the module was built with
  std::uint32_t table_size;         ///< sizeof(halyard_effect_table)
  const char* compiler;             ///< halyard::kEffectCompiler
  const std::uint32_t* layout;      ///< halyard::kEffectLayout
  std::uint32_t layout_size;        ///< number of entries of `layout`
  /// Appends new effects.
  void (*make)(std::vector<std::unique_ptr<const halyard::Effect>>& effects);
};

/// The function that a module exports. The table keeps its address while the module is loaded.
extern "C" __attribute__((visibility("default"))) const halyard_effect_table* halyard_effects();

namespace halyard {

#define HALYARD_TEXT_OF(x) #x
#define HALYARD_TEXT(x) HALYARD_TEXT_OF(x)
#if defined(__clang__)
#define HALYARD_COMPILER "Clang " HALYARD_TEXT(__clang_major__)
#else
#define HALYARD_COMPILER "GCC " HALYARD_TEXT(__GNUC__)
#endif
#if defined(__GLIBCXX__)
#define HALYARD_LIBRARY "libstdc++, strings " HALYARD_TEXT(_GLIBCXX_USE_CXX11_ABI)
#else
#define HALYARD_LIBRARY "another standard library"
#endif
#if defined(_GLIBCXX_DEBUG)
#define HALYARD_CHECKED ", debug containers"
#else
#define HALYARD_CHECKED ""
#endif
/// Compiler, its C++ ABI, and the standard library whose strings and vectors cross the boundary. Each module has a copy
/// of its own, also one without hidden visibility.
constexpr char kEffectCompiler[] =
    HALYARD_COMPILER ", C++ ABI " HALYARD_TEXT(__GXX_ABI_VERSION) ", " HALYARD_LIBRARY HALYARD_CHECKED;
#undef HALYARD_CHECKED
#undef HALYARD_LIBRARY
#undef HALYARD_COMPILER
#undef HALYARD_TEXT
#undef HALYARD_TEXT_OF

namespace effect_module {

template <class... Types>
struct LayoutOf {
  static constexpr std::uint32_t value[] = {std::uint32_t(sizeof(Types))..., std::uint32_t(alignof(Types))...};
};

template <class... Effects>
void make(std::vector<std::unique_ptr<const Effect>>& effects) {
  (effects.push_back(std::make_unique<const Effects>()), ...);
}

using Layout = LayoutOf<Effect, EffectParameter, CommandHistory, Dual, Lanes, LaneMask, JointParameters<double>,
                        JointParameters<Dual>, JointParameters<Lanes>, ArmParameters<double>, ArmParameters<Dual>,
                        ArmParameters<Lanes>, JointSignals<double>, JointSignals<Dual>, JointSignals<Lanes>,
                        EffectContext<double>, EffectContext<Dual>, EffectContext<Lanes>, std::string, RefinesSearch,
                        SearchSpace, ParameterSearch, Tolerances>;

}  // namespace effect_module

/// Sizes, then alignments, of the types that cross the boundary.
inline constexpr auto& kEffectLayout = effect_module::Layout::value;

/// The table of these effect classes; make() constructs each by its default constructor.
template <class... Effects>
halyard_effect_table effect_table() {
  return {HALYARD_EFFECT_INTERFACE,
          sizeof(halyard_effect_table),
          kEffectCompiler,
          kEffectLayout,
          std::uint32_t(std::size(kEffectLayout)),
          effect_module::make<Effects...>};
}

}  // namespace halyard
