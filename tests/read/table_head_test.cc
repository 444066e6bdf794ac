#include "lyrefit/read/table_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TableHead Head(const char* line, HeadLine kind = HeadLine::kText) {
  TableHead head;
  ReadHeadLine(line, 3, kind, &head);
  return head;
}

TEST(ReadHeadLineTest, TakesWhatIsClearlyStated) {
  for (const char* line : {"Measured Irradiance (W/m^2),912", "Irr:\t912", "POA 912 W/m2",
                           "E(kW/m2),0.912", "Irr [W/m2];912,0", "G = 912 W/m2",
                           "Light intensity (mW/cm2): 91.2", "Irradiance: 0.912 suns"}) {
    EXPECT_NEAR(Head(line).said.irradiance_W_m2.value_or(0), 912, 1e-9) << line;
  }
  for (const char* line :
       {"Measured Cell Temp (C),47.3", "Tc [\u00b0C];47,3", "Tmod:\t47.3",
        "Module temperature = 47.3 C", "cell_temperature_K,320.45", "Modultemperatur;47,3",
        "Zelltemperatur: 47,3 \u00b0C", "Tmodul;47,3", "Backsheet temperature: 47.3",
        "Temperatur Modul [\u00b0C];47,3", "Module backsheet temp (C),47.3"}) {
    EXPECT_NEAR(Head(line).said.temperature_C.value_or(0), 47.3, 1e-9) << line;
  }
  for (const char* line : {"Number of cells,60", "Cells in series: 60", "Ns = 60", "cells\t60"}) {
    EXPECT_EQ(Head(line).said.cells_in_series.value_or(0), 60) << line;
  }
  for (const char* line : {"bypass_diodes: 3", "Bypass diodes,3", "Number of bypass diodes = 3"}) {
    EXPECT_EQ(Head(line).said.notes.bypass_diodes.value_or(0), 3) << line;
    EXPECT_FALSE(Head(line).said.cells_in_series) << line;
  }
  for (const char* line : {"Cell area (cm2)\t4", "Device Area = 4 cm2", "area_mm2: 400",
                           "Size [cm2]\t4", "AREA\tQUANT\t4.00000E+000\tSample Area (cm^2)"}) {
    EXPECT_NEAR(Head(line).said.notes.area_cm2.value_or(0), 4, 1e-9) << line;
  }
  for (const char* line : {"Compliance (mA): 100", "Current limit: 0.1 A"}) {
    EXPECT_NEAR(Head(line).said.notes.compliance_A.value_or(0), 0.1, 1e-12) << line;
  }
  for (const char* line : {"Date,6/21/2015", "Date: 6/21/2015", "DATE\t6/21/2015"}) {
    EXPECT_EQ(Head(line).said.notes.date, "6/21/2015") << line;
  }
}

TEST(ReadHeadLineTest, TakesTheSetupOfTheMeasurement) {
  EXPECT_EQ(Head("Tester: flasher of class AAA").said.notes.setup, Setup::kFlash);
  EXPECT_EQ(Head("Light source,Sun simulator").said.stated_in.setup, "line 3");
  EXPECT_EQ(Head("Light source,Lamp").said.notes.setup, Setup::kUnknown);
}

TableHead HeadOf(const std::vector<const char*>& lines) {
  TableHead head;
  int number = 0;
  for (const char* line : lines) ReadHeadLine(line, ++number, HeadLine::kText, &head);
  return head;
}

TEST(ReadHeadLineTest, TakesModulesInFourLanguages) {
  for (const char* line :
       {"Modules in series,20", "Number of modules: 20", "Modules per string;20", "Modules: 20",
        "Anzahl Module in Reihe;20", "Module in Reihe: 20", "Anzahl Module;20", "Modulanzahl: 20",
        "Anzahl der Module pro Strang;20", "Módulos en serie;20", "Número de módulos: 20",
        "Módulos por cadena;20", "Modules en série;20", "Nombre de modules: 20",
        "Nombre de modules par chaîne;20", "20 modules", "20 Module"}) {
    EXPECT_EQ(Head(line).said.notes.modules_in_series.value_or(0), 20) << line;
    EXPECT_THAT(Head(line).left, IsEmpty()) << line;
  }
  for (const char* line :
       {"Module number: 20", "Module: 20", "Modul Nr.: 20", "Modules in parallel: 20",
        "Module series: 20", "Module type: 20", "Modules: 20 W", "Modules in series: 1.5"}) {
    EXPECT_FALSE(Head(line).said.notes.modules_in_series) << line;
  }
  for (const char* line :
       {"Cells per module,60", "Number of cells per module: 60", "Zellen pro Modul;60",
        "Anzahl Zellen je Modul;60", "Células por módulo: 60", "Celdas por módulo;60",
        "Cellules par module;60", "Nombre de cellules par module;60"}) {
    EXPECT_EQ(Head(line).module_cells.value_or(0), 60) << line;
  }
  for (const char* line : {"Anzahl Zellen;60", "Zellenzahl: 60", "Número de células: 60",
                           "Nombre de cellules;60", "60 cells", "60 Zellen"}) {
    EXPECT_EQ(Head(line).said.cells_in_series.value_or(0), 60) << line;
  }
}

TEST(ReadHeadLineTest, MakesTheCellsOfAStringOfItsModules) {
  for (const auto& lines :
       std::vector<std::vector<const char*>>{{"Modules in series,20", "Cells per module,60"},
                                             {"Cells per module,60", "Modules in series,20"},
                                             {"Number of modules: 20", "Number of cells: 60"},
                                             {"Number of cells: 60", "Number of modules: 20"},
                                             {"20 modules, 60 cells per module"}}) {
    const TableHead head = HeadOf(lines);
    EXPECT_EQ(head.said.cells_in_series.value_or(0), 1200) << lines.front();
    EXPECT_THAT(SentencesOf(head.assumptions),
                ::testing::Contains(HasSubstr("cells in series 1200: 20 modules of 60 cells")));
  }
  const TableHead whole = HeadOf({"Number of modules: 20", "Number of cells: 1200"});
  EXPECT_EQ(whole.said.cells_in_series.value_or(0), 1200);
  EXPECT_FALSE(HeadOf({"Modules in series,20"}).said.cells_in_series);
}

TEST(ReadHeadLineTest, TakesSeveralConditionsOfOneComment) {
  TableHead head = Head("# cell temperature 50.2 C, 20 Module", HeadLine::kComment);
  EXPECT_NEAR(head.said.temperature_C.value_or(0), 50.2, 1e-9);
  EXPECT_EQ(head.said.notes.modules_in_series.value_or(0), 20);
  EXPECT_THAT(head.left_temperatures, IsEmpty());
  for (const char* line : {"# G = 873 W/m2, T = 50.2 C", "# T = 50.2 C; G = 873 W/m2"}) {
    head = Head(line, HeadLine::kComment);
    EXPECT_NEAR(head.said.irradiance_W_m2.value_or(0), 873, 1e-9) << line;
    EXPECT_NEAR(head.said.temperature_C.value_or(0), 50.2, 1e-9) << line;
  }
  EXPECT_FALSE(Head("# T = 50.2 C", HeadLine::kComment).said.temperature_C) << "of what?";
}

TEST(ReadHeadLineTest, TakesLightInSunsAndConcentrations) {
  for (const auto& [line, irradiance] :
       {std::pair("Light level;50 % sun", 500.0), std::pair("Light Intensity,50,% sun", 500.0),
        std::pair("Intensity: 0.5 sun", 500.0), std::pair("Illumination,300 suns", 3e5),
        std::pair("# Geometric concentration: 300X", 3e5), std::pair("Concentration,300", 3e5),
        std::pair("Light: 50 mW/cm2", 500.0), std::pair("Irradiance: 0.5 kW/m2", 500.0)}) {
    EXPECT_EQ(Head(line).said.irradiance_W_m2.value_or(0), irradiance) << line;
  }
  for (const char* line : {"Light: 50 %", "Doping concentration: 300", "Concentration: 3 mol"}) {
    EXPECT_FALSE(Head(line).said.irradiance_W_m2) << line;
  }
}

TEST(ReadHeadLineTest, LightInLuxStatesNoIrradiance) {
  for (const char* line :
       {"Lamp,250 lux (LED 3000 K)", "Illuminance: 250 lx", "光照度：0.25 klux"}) {
    const TableHead head = Head(line);
    EXPECT_EQ(head.said.notes.illuminance_lux.value_or(0), 250) << line;
    EXPECT_FALSE(head.said.irradiance_W_m2) << line;
  }
}

TEST(ReadHeadLineTest, WordsMayStateTheLight) {
  for (const char* line : {"Illumination: room light", "Light source;ambient light (tubes)",
                           "Light\tindoor", "Lamp: office lighting", "Beleuchtung: Raumlicht"}) {
    const TableHead head = Head(line);
    EXPECT_THAT(head.said.light, HasSubstr("line 3")) << line;
    EXPECT_FALSE(head.said.irradiance_W_m2) << line;
  }
  for (const char* line : {"Illumination: dark", "Light: off", "Lamp,light off"}) {
    EXPECT_EQ(Head(line).said.irradiance_W_m2, 0) << line;
  }
  for (const char* line :
       {"Ambient temperature: 21", "Place: office 4", "Light source: class AAA"}) {
    EXPECT_EQ(Head(line).said.light, "") << line;
    EXPECT_FALSE(Head(line).said.irradiance_W_m2) << line;
  }
}

TEST(ReadHeadLineTest, TheIrradianceOfASunIsNoneOfARoom) {
  TableHead head;
  ReadHeadLine("Irradiance (W/m2): 1000", 2, HeadLine::kText, &head);
  ReadHeadLine("Light: room light", 3, HeadLine::kText, &head);
  EXPECT_FALSE(head.said.irradiance_W_m2);
  EXPECT_THAT(SentencesOf(head.assumptions),
              ElementsAre(HasSubstr("irradiance of 1000 W/m2 not used, since line 3")));
  head = {};
  ReadHeadLine("Irradiance (W/m2): 3.2", 2, HeadLine::kText, &head);
  ReadHeadLine("Light: room light", 3, HeadLine::kText, &head);
  EXPECT_EQ(head.said.irradiance_W_m2, 3.2);
}

TEST(ReadHeadLineTest, UnderstandsOtherLanguages) {
  for (const char* line :
       {"Température cellule (°C);47,3", "Temperatura de célula: 47,3 ºC", "Temperatura cella;47,3",
        "Temperatura da célula (°C);47,3", "Температура ячеек, °C;47,3", "电池温度（℃）：47.3",
        "モジュール温度：47.3 ℃", "Rückseitentemperatur;47,3"}) {
    EXPECT_NEAR(Head(line).said.temperature_C.value_or(0), 47.3, 1e-9) << line;
  }
  for (const char* line :
       {"Éclairement (W/m²);912", "Irradiancia: 912 W/m2", "Irraggiamento;912",
        "Освещённость, Вт/м²;912", "辐照度：912 W/m2", "日射強度（W/m²）：912"}) {
    EXPECT_EQ(Head(line).said.irradiance_W_m2.value_or(0), 912) << line;
  }
  for (const char* line : {"Anzahl der Zellen;60", "Nombre de cellules: 60", "Numero di celle;60",
                           "Número de celdas: 60", "Число ячеек;60", "直列セル数：60"}) {
    EXPECT_EQ(Head(line).said.cells_in_series.value_or(0), 60) << line;
  }
  for (const char* line : {"Température ambiante;21", "Umgebungstemperatur;21", "环境温度：21"}) {
    EXPECT_FALSE(Head(line).said.temperature_C) << line;
  }
}

TEST(ReadHeadLineTest, AValueForEachPixelCountsIfAllAreEqual) {
  TableHead head;
  ReadHeadLine("active area [cm2]:\t0.16\t0.16\t0.16", 1, HeadLine::kText, &head);
  ReadHeadLine("compliance [mA/cm2]:\t30", 2, HeadLine::kText, &head);
  EXPECT_EQ(head.said.notes.area_cm2, 0.16);
  EXPECT_NEAR(head.said.notes.compliance_A.value_or(0), 0.0048, 1e-12);
  for (const char* line : {"Cell area(cm^2)\t[0.16, 0.16]", "Cell area(cm^2)\t0.16"}) {
    EXPECT_EQ(Head(line).said.notes.area_cm2, 0.16) << line;
  }
  EXPECT_FALSE(Head("active area [cm2]:\t0.16\t0.2").said.notes.area_cm2);
  EXPECT_EQ(Head("Power Density (mW/cm^2)\t100").said.irradiance_W_m2, 1000);
  EXPECT_EQ(Head("Incident Power (mW/cm^2): 90 mW/cm^2").said.irradiance_W_m2, 900);
  EXPECT_EQ(Head("Pin [W/m2];1000").said.irradiance_W_m2, 1000);
  EXPECT_FALSE(Head("Input power (mW): 100").said.irradiance_W_m2.has_value());
  EXPECT_EQ(Head("Parallel_Strings: 2").said.strings_in_parallel, 2);
}

TEST(ReadHeadLineTest, LeavesWhatIsNotClear) {
  for (const char* line :
       {"Temp1 47.3", "T1(C),47.3", "Ambient temperature (C),20", "GHI (W/m2),800",
        "Reference irradiance (W/m2): 1000", "Rated power (W),240", "Cells in parallel: 2",
        "Isc 8.90 Voc 36.0", "Area: 4", "Temperature: 320", "Irradiance (W/m2): -5",
        "Number of cells: 2.5", "Light: 1"}) {
    const TableHead head = Head(line);
    EXPECT_THAT(SentencesOf(head.assumptions), IsEmpty()) << line;
    EXPECT_THAT(head.left, ElementsAre(HasSubstr("line 3 '"))) << line;
  }
  for (const char* line :
       {"Tracer", "Serial,AB-12-C", "Time,12:34:56", "Version,3.6.1120", ",,", ""}) {
    EXPECT_THAT(Head(line).left, IsEmpty()) << line;
  }
}

TEST(ReadHeadLineTest, ALineThatMayStateTheTemperatureIsKept) {
  for (const char* line : {"Temp1 47.3", "Sensortemperatur;47,3", "Temperature: 320"}) {
    const TableHead head = Head(line);
    EXPECT_THAT(head.left_temperatures, ElementsAre(HasSubstr("line 3 '"))) << line;
    EXPECT_THAT(SentencesOf(HeadSentences(head)),
                ElementsAre(HasSubstr("speaks of a temperature"), HasSubstr("not understood")));
  }
  for (const char* line : {"Ambient temperature (C),20", "Umgebungstemperatur;20,1", "Foo: 12",
                           "Temperature coefficient of Voc: -0.3", "Modultemperatur;47,3"}) {
    EXPECT_THAT(Head(line).left_temperatures, IsEmpty()) << line;
  }
}

TEST(ReadHeadLineTest, CommentsAreRemarksUnlessClear) {
  EXPECT_EQ(Head("# irradiance: 912 W/m2", HeadLine::kComment).said.irradiance_W_m2, 912);
  EXPECT_THAT(Head("# run 12 of 30", HeadLine::kComment).left, IsEmpty());
}

TEST(ReadHeadLineTest, TheFirstStatementCounts) {
  TableHead head;
  ReadHeadLine("Irradiance (W/m2),912", 1, HeadLine::kText, &head);
  ReadHeadLine("Irradiance (W/m2),1000", 2, HeadLine::kText, &head);
  EXPECT_EQ(head.said.irradiance_W_m2, 912);
  EXPECT_THAT(head.left, ElementsAre("line 2 'Irradiance (W/m2),1000'"));
}

TEST(HeadSentencesTest, ShowSomeOfTheLinesThatWereLeft) {
  TableHead head;
  ReadHeadLine("Irradiance (W/m2),912", 1, HeadLine::kText, &head);
  for (int i = 2; i < 12; ++i) ReadHeadLine("Foo: 12", i, HeadLine::kText, &head);
  EXPECT_THAT(
      SentencesOf(HeadSentences(head)),
      ElementsAre("irradiance 912 W/m2 taken from line 1 'Irradiance (W/m2),912'",
                  "not understood, and not used: line 2 'Foo: 12', line 3 'Foo: 12', line 4 "
                  "'Foo: 12', line 5 'Foo: 12', line 6 'Foo: 12', line 7 'Foo: 12' and 4 "
                  "more"));
}

TEST(HeadSentencesTest, TellResultsFromWhatIsNotUnderstood) {
  TableHead head;
  int line = 0;
  for (const char* text :
       {"I_sc [A]: 3.79E-3", "JSC [mA/cm2]: -21.9 -21.9", "Fill factor: 67.9", "Voc (V)\t1.02",
        "Efficiency [pct.]: 18", "Pmpp [mW]: 23.7", "Averaged Points 3"}) {
    ReadHeadLine(text, ++line, HeadLine::kText, &head);
  }
  EXPECT_EQ(head.results.size(), 6U);
  EXPECT_THAT(head.left, ElementsAre("line 7 'Averaged Points 3'"));
  EXPECT_THAT(
      SentencesOf(HeadSentences(head)).front(),
      ::testing::StartsWith("stated key points and results, not used in a fit: line 1 'I_sc"));
}

}  // namespace
}  // namespace lyrefit
