#pragma once

#include <optional>

#include "model/extensions/field.h"

// Fields of EnergyPlus's own objects that say where and when, as Energy+.idd has them.
namespace gpu_shading::energyplus {

namespace site_location {

inline constexpr std::string_view type = "Site:Location";
inline constexpr Field<double> latitude{{.key = "latitude",
                                         .title = "Latitude",
                                         .kind = FieldKind::real,
                                         .minimum = Limit{-90.0, false},
                                         .maximum = Limit{90.0, false},
                                         .units = "deg",
                                         .blank = "0"}};
inline constexpr Field<double> longitude{{.key = "longitude",
                                          .title = "Longitude",
                                          .kind = FieldKind::real,
                                          .minimum = Limit{-180.0, false},
                                          .maximum = Limit{180.0, false},
                                          .units = "deg",
                                          .blank = "0"}};
inline constexpr Field<double> time_zone{{.key = "time_zone",
                                          .title = "Time Zone",
                                          .kind = FieldKind::real,
                                          .minimum = Limit{-12.0, false},
                                          .maximum = Limit{14.0, false},
                                          .units = "hr",
                                          .blank = "0"}};
inline constexpr Field<double> elevation{{.key = "elevation",
                                          .title = "Elevation",
                                          .kind = FieldKind::real,
                                          .minimum = Limit{-300.0, false},
                                          .maximum = Limit{8900.0, true},
                                          .units = "m",
                                          .blank = "0"}};

}  // namespace site_location

namespace run_period {

inline constexpr std::string_view type = "RunPeriod";
// The dictionary has no limits here; these are years of the Gregorian calendar.
inline constexpr Field<std::optional<int>> begin_year{{.key = "begin_year",
                                                       .title = "Begin Year",
                                                       .kind = FieldKind::integer,
                                                       .minimum = Limit{1583.0, false},
                                                       .maximum = Limit{9999.0, false}}};
inline constexpr Field<int> begin_month{{.key = "begin_month",
                                         .title = "Begin Month",
                                         .kind = FieldKind::integer,
                                         .minimum = Limit{1.0, false},
                                         .maximum = Limit{12.0, false},
                                         .blank = "1"}};
inline constexpr Field<int> begin_day{{.key = "begin_day_of_month",
                                       .title = "Begin Day of Month",
                                       .kind = FieldKind::integer,
                                       .minimum = Limit{1.0, false},
                                       .maximum = Limit{31.0, false},
                                       .blank = "1"}};

}  // namespace run_period
}  // namespace gpu_shading::energyplus
