#include "lyrefit/read/key_point_table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lyrefit {
namespace {

// The key point that a label names with its factor, as text; "-" if none.
std::string PointOf(const std::string& label) {
  constexpr const char* kTexts[] = {"isc", "voc", "imp", "vmp", "pmp"};
  const auto column = AsKeyPoint(label);
  if (!column) return "-";
  return std::string(kTexts[column->point]) + (column->factor == 1 ? "" : " in other units");
}

TEST(KeyPointNamesTest, NamesOfProgramsAndLanguages) {
  for (const char* label :
       {"Isc", "i_sc_A", "ISC (A)", "Icc (A)", "Ik [A]", "Kurzschlussstrom [A]",
        "Corrente di cortocircuito [A]", "Corriente de corto-circuito (A)",
        "Corrente de curto-circuito (A)", "Courant de court-circuit (A)", "Iкз, А", "短路电流(A)",
        "短路电流（A）", "短絡電流 [A]", "Short circuit current"}) {
    EXPECT_EQ(PointOf(label), "isc") << label;
  }
  for (const char* label :
       {"VOC", "Uoc [V]", "Vco (V)", "Leerlaufspannung [V]", "Tension de circuit ouvert (V)",
        "Tensione a vuoto [V]", "Tensión de circuito abierto (V)", "Tensão de circuito aberto (V)",
        "Uхх, В", "开路电压(V)", "開放電圧 (V)", "Open-circuit voltage"}) {
    EXPECT_EQ(PointOf(label), "voc") << label;
  }
  for (const char* label :
       {"Impp", "Ipm (A)", "Im (A)", "Ipmp (A)", "MPP-Strom [A]",
        "Courant à puissance maximale (A)", "Corrente de máxima potência (A)", "Iмпп, А",
        "最大功率点电流(A)", "峰值电流（A）", "Current at maximum power (A)"}) {
    EXPECT_EQ(PointOf(label), "imp") << label;
  }
  for (const char* label :
       {"VMP", "Umpp [V]", "Vpm", "Vm (V)", "MPP-Spannung [V]", "Tensione MPP [V]",
        "最大功率点电压(V)", "最大出力動作電圧(V)", "Uмпп, В"}) {
    EXPECT_EQ(PointOf(label), "vmp") << label;
  }
  for (const char* label : {"PMP", "Pm (W)", "Ppm", "Pmax", "MPP-Leistung [W]", "Potenza MPP [W]",
                            "Puissance maximale", "最大功率(W)", "Pмакс, Вт"}) {
    EXPECT_EQ(PointOf(label), "pmp") << label;
  }
  EXPECT_EQ(PointOf("Isc (mA)"), "isc in other units");
}

TEST(KeyPointNamesTest, OtherQuantitiesAreNoKeyPoints) {
  for (const char* label :
       {"Current (A)", "Voltage (V)", "Power (W)", "Isc (V)", "Temperature (C)",
        "Isc temperature coefficient", "FF", "Maximum current limit", "G (W/m2)"}) {
    EXPECT_EQ(PointOf(label), "-") << label;
  }
}

TEST(KeyPointNamesTest, AMatrixHasLightTemperatureAndNoReadingsOfACurve) {
  const auto matrix = AsMatrix({"IRR", "TC", "PMP", "VMP", "VOC", "ISC"});
  ASSERT_TRUE(matrix);
  EXPECT_EQ(matrix->irradiance_place, 0);
  EXPECT_EQ(matrix->temperature_place, 1);
  EXPECT_TRUE(AsMatrix({"G (W/m2)", "Tc (C)", "Icc (A)", "Im (A)", "Vm (V)"}));
  EXPECT_FALSE(AsMatrix({"G (W/m2)", "Tc (C)", "Im (A)", "Vm (V)", "Pm (W)"}));
  EXPECT_FALSE(AsMatrix({"G (W/m2)", "Tc (C)", "Isc", "Voc", "Pmp", "Voltage (V)", "Current (A)"}));
  EXPECT_FALSE(AsMatrix({"IRR", "PMP", "VMP", "VOC", "ISC"}));
  EXPECT_FALSE(AsMatrix({"Suns", "TC", "VOC", "V (V)"}));
}

}  // namespace
}  // namespace lyrefit
