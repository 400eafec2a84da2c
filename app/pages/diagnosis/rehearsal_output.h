#pragma once
/// What a rehearsal of a diagnosis shows: lines for the terminal and the report, and a member of diagnosis.json.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/report/page.h"
#include "diagnosis/rehearse.h"

namespace halyard {

/// One line for each kind of truth that was rehearsed, one about rehearsals that failed, and one about names.
std::vector<std::string> rehearsal_lines(const Rehearsal& rehearsal);

/// The member "rehearsal" of diagnosis.json.
nlohmann::ordered_json rehearsal_json(const Diagnosis& diagnosis, const Rehearsal& rehearsal);

/// The lines, the probabilities of the diagnosis' names, and a table of the rehearsals.
void add_rehearsal(report::Page& page, const Diagnosis& diagnosis, const Rehearsal& rehearsal);

}  // namespace halyard
