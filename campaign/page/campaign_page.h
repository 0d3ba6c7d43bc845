// A campaign as one self-contained HTML page: distributions of its measures, and its failed flights.
#pragma once

#include <string>

#include "campaign/records/flight_table.h"

namespace tern {

/// @param failures  folder of the failed flights, as a link relative to the page; "": no links
std::string campaign_page(const Flights& flights, const std::string& failures);

}  // namespace tern
