#pragma once
/// For authors of effects: a module is one or more classes derived from EffectOf (transmission/effect.h) and
///
///   extern "C" const halyard_effect_table* halyard_effects() {
///     static const auto table = halyard::effect_table<MyEffect, MyOtherEffect>();
///     return &table;
///   }
///
/// `halyard COMMAND --effects MODULE.so` adds them to the library: from then on their names stand in model and scenario
/// files, in sweeps, and the diagnosis tries them at every joint that can have them. An effect that derives from
/// RefinesSearch as well (diagnosis/search_space.h) says from where the diagnosis is to look for its parameters.
///
/// Unlike an estimator, an effect is called inside the equations, over double, Dual and Lanes: what crosses is C++. So
/// a module says what it was compiled by, and how large the types that cross are there, before anything of it is used.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/search_space.h"
#include "transmission/effect.h"

/// Counts up when anything that crosses changes its meaning or place.
#define HALYARD_EFFECT_INTERFACE 2

/// Of the table the first two members may be read whatever the version, `compiler` and the layout before make is
/// called.
struct halyard_effect_table {
  std::uint32_t interface_version;  ///< HALYARD_EFFECT_INTERFACE of the headers that the module was built with
  std::uint32_t table_size;         ///< sizeof(halyard_effect_table)
  const char* compiler;             ///< halyard::kEffectCompiler
  const std::uint32_t* layout;      ///< halyard::kEffectLayout
  std::uint32_t layout_size;        ///< its entries
  /// Appends new effects.
  void (*make)(std::vector<std::unique_ptr<const halyard::Effect>>& effects);
};

/// What a module exports. The table stays where it is as long as the module is loaded.
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
/// Compiler, its C++ ABI, and the standard library whose strings and vectors cross.
inline constexpr char kEffectCompiler[] =
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

/// Sizes, then alignments, of the types that cross.
inline constexpr auto& kEffectLayout = effect_module::Layout::value;

/// The table of these effects, each made by its default constructor.
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
