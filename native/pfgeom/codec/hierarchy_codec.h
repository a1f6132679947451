// The coded hierarchy of perturbations: one walk over the levels, run by encoder and decoder alike. Centres
// are derived from what was decoded before; only quantised form factors and flags for thin cells are stored.
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"
#include "pfgeom/eval/derive.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Codes `function.head` and its levels, or reads into it (then base and levels are made, with everything
/// that is derived). `budget`: one for the whole file, DeriveBudget::of_bytes(bytes of the stream); the
/// encoder passes an unlimited one. Kinds 0..127 of the mixer are this codec's. Ends with a 16-bit check over
/// the derived centres (derivation_mismatch).
FormatStatus code_hierarchy(EntropyCoder& coder, ContextMixer& mixer, Function& function,
                            DeriveBudget& budget, const Task& task = {});

}  // namespace pfgeom
