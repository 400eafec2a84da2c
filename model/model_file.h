#pragma once
/// Model files: an arm in XML.

#include <filesystem>
#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

class XmlElement;

/// Reads a model file. Throws InputError `file:line: <element attribute="...">: expected ...; remedy`.
ArmModel read_model(const std::filesystem::path& path);

/// The same from text, as plug-ins receive it; `source` names the text in messages.
ArmModel parse_model(const std::string& xml, const std::string& source);

/// Reads an <effects> element of a model file or of another file that places effects on an arm, after those that the
/// model has. Throws InputError, also if they change the arm to an impossible one, such as one with negative friction.
std::vector<PlacedEffect> read_effects(const XmlElement& effects, const ArmModel& model);

/// The model as XML, from which read_model restores every number to the last bit.
std::string model_to_xml(const ArmModel& model);

}  // namespace halyard
