#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/model/device.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

std::string CertificateCsv(const Certificate& certificate) {
  std::vector<ParameterInfo> infos;  // of the largest model
  for (const ModelCertificate& model : certificate.models) {
    const Device device = MakeDevice(model.model, certificate.curve.conditions);
    if (device.parameters.size() > infos.size()) infos = device.parameters;
  }
  std::string csv = "model,certified,rmse_A,lower_bound_A,gap,above_floor";
  for (const ParameterInfo& info : infos) {
    csv += "," + CsvField(info.symbol + (info.unit.empty() ? "" : "_" + info.unit));
  }
  csv += "\n";
  const Floor& floor = certificate.floor;
  csv += CsvLine({"floor", floor.certified ? "yes" : "no", CsvField(floor.rmse_A),
                  CsvField(floor.lower_bound_A), CsvField(floor.gap), "0"});
  csv.insert(csv.size() - 1, std::string(infos.size(), ','));
  for (const ModelCertificate& model : certificate.models) {
    std::vector<std::string> fields = {ToText(model.model),    model.certified ? "yes" : "no",
                                       CsvField(model.rmse_A), CsvField(model.lower_bound_A),
                                       CsvField(model.gap),    CsvField(model.above_floor)};
    for (std::size_t k = 0; k < infos.size(); ++k) {
      fields.push_back(k < model.parameters.size() ? CsvField(model.parameters[k]) : "");
    }
    csv += CsvLine(fields);
  }
  return csv;
}

}  // namespace lyrefit
