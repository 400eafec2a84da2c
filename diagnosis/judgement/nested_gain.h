#pragma once
/// Does an effect explain anything of a residual? The hypothesis without the effect is the one with it at size zero:
/// the two are nested. The square of the error with the effect contains, beside what is unexplained, the error of the
/// fitted size. A difference of the squares is therefore positive on average only if more than half of the fitted size
/// is right. That no effect is there is tested by what the change and the residual have in common:
///
///   g_b = Σ_c (n_bc / m)  2 ⟨e d⟩ / (⟨e²⟩ + ⟨d²⟩ + λ_c²),   d = e - e'
///
///   e, e'  residuals without and with the effect; ⟨ ⟩ is the mean over the n_bc rows of block b and channel c
///   m      rows that equal one independent sample
///   λ_c    residual below which a block counts less
///
/// Without an effect d has nothing in common with e, and g_b is zero on average; if the effect explains all, d = e. A
/// block adds at most its independent samples, so none dominates.
///
/// Source: 2 e d = e² - (e'² - d²) is the adjusted difference of Clark and West, J. Econometrics 138 (2007) 291-311.

#include "diagnosis/fit/evidence.h"

namespace halyard {

/// g_b of the deciding blocks that have rows. least_square: λ_c², [2n].
std::vector<double> nested_gains(const Evidence& evidence, const Score& with, const Score& without,
                                 const std::vector<double>& least_square);

}  // namespace halyard
