#include "lyrefit/cite/references.h"

namespace lyrefit {
namespace {

constexpr char kIec[] = "{International Electrotechnical Commission}";
constexpr char kJcgm[] = "{Joint Committee for Guides in Metrology}";

}  // namespace

// Facts are those of texts at hand: of the publication, or of two or more that cite it alike. What
// none states is empty.
const std::vector<Publication>& Publications() {
  static const std::vector<Publication> references = {
      // Searches.
      {"mlo", "article", "", "", "Journal of Industrial and Management Optimization", "", "22", "1",
       "642--690", "",
       "algorithm=mlo algorithm=mlo+vector algorithm=mlo+shape algorithm=lo+mblss "
       "algorithm=lo+dmlss bounds=table1 bounds=paper "
       "constants=paper"},
      {"dehghani2023", "article",
       "Dehghani, M. and Bektemyssova, G. and Montazeri, Z. and Shaikemelev, G. and Malik, O. P. "
       "and Dhiman, G.",
       "Lyrebird Optimization Algorithm: A New Bio-Inspired Metaheuristic Algorithm for Solving "
       "Optimization Problems",
       "Biomimetics", "2023", "8", "6", "507", "10.3390/biomimetics8060507",
       "algorithm=lo algorithm=mlo algorithm=mlo+vector algorithm=mlo+shape algorithm=lo+mblss "
       "algorithm=lo+dmlss"},
      {"storn1997", "article", "Storn, R. and Price, K.",
       "Differential Evolution -- A Simple and Efficient Heuristic for Global Optimization over "
       "Continuous Spaces",
       "Journal of Global Optimization", "1997", "11", "4", "341--359", "10.1023/A:1008202821328",
       "algorithm=de"},
      {"biscani2020", "article", "Biscani, Francesco and Izzo, Dario",
       "A parallel global multiobjective framework for optimization: pagmo",
       "Journal of Open Source Software", "2020", "5", "53", "2338", "10.21105/joss.02338",
       "algorithm=pagmo:*"},
      {"hansen2001", "article", "Hansen, Nikolaus and Ostermeier, Andreas",
       "Completely Derandomized Self-Adaptation in Evolution Strategies",
       "Evolutionary Computation", "2001", "9", "2", "159--195", "10.1162/106365601750190398",
       "name=cma_es algorithm=pagmo:cmaes"},
      {"clerc2002", "article", "Clerc, Maurice and Kennedy, James",
       "The particle swarm -- explosion, stability, and convergence in a multidimensional complex "
       "space",
       "IEEE Transactions on Evolutionary Computation", "2002", "6", "1", "58--73",
       "10.1109/4235.985692", "name=particle_swarm"},
      {"mirjalili2014", "article",
       "Mirjalili, Seyedali and Mirjalili, Seyed Mohammad and Lewis, Andrew", "Grey Wolf Optimizer",
       "Advances in Engineering Software", "2014", "69", "", "46--61",
       "10.1016/j.advengsoft.2013.12.007", "name=grey_wolf algorithm=pagmo:gwo"},
      {"corana1987", "article", "Corana, A. and Marchesi, M. and Martini, C. and Ridella, S.",
       "Minimizing multimodal functions of continuous variables with the ``simulated annealing'' "
       "algorithm",
       "ACM Transactions on Mathematical Software", "1987", "13", "3", "262--280",
       "10.1145/29380.29864", "name=simulated_annealing algorithm=pagmo:simulated_annealing"},
      // Fits and their intervals.
      {"ceres", "software", "Agarwal, Sameer and Mierle, Keir and {The Ceres Solver Team}",
       "{Ceres Solver}", "", "2022", "", "", "", "",
       "refine refined law base procedure=desoto procedure=pvsyst"},
      {"chao1987", "article", "Chao, A.",
       "Estimating the Population Size for Capture-Recapture Data with Unequal Catchability",
       "Biometrics", "1987", "43", "4", "783--791", "10.2307/2531532", "local_optima"},
      {"patterson1971", "article", "Patterson, H. D. and Thompson, R.",
       "Recovery of inter-block information when block sizes are unequal", "Biometrika", "1971",
       "58", "3", "545--554", "10.1093/biomet/58.3.545", "current_noise_A noise_model"},
      {"satterthwaite1946", "article", "Satterthwaite, F. E.",
       "An approximate distribution of estimates of variance components", "Biometrics Bulletin",
       "1946", "2", "6", "110--114", "10.2307/3002019", "current_noise_A"},
      {"vanloan1985", "article", "Van Loan, C.",
       "On the Method of Weighting for Equality-Constrained Least-Squares Problems",
       "SIAM Journal on Numerical Analysis", "1985", "22", "5", "851--864", "10.1137/0722051",
       "floor lower_bound_A"},
      // Devices.
      {"shockley1949", "article", "Shockley, W.",
       "The Theory of p-n Junctions in Semiconductors and p-n Junction Transistors",
       "Bell System Technical Journal", "1949", "28", "3", "435--489",
       "10.1002/j.1538-7305.1949.tb03645.x",
       "model=sd model=dd model=td base=sd base=dd base=td resistance_series nNsVth"},
      {"sah1957", "article", "Sah, C.-T. and Noyce, R. N. and Shockley, W.",
       "Carrier Generation and Recombination in P-N Junctions and P-N Junction Characteristics",
       "Proceedings of the IRE", "1957", "45", "9", "1228--1243", "10.1109/JRPROC.1957.278528",
       "model=dd model=td base=dd base=td"},
      {"merten1998", "article",
       "Merten, J. and Asensi, J. M. and Voz, C. and Shah, A. V. and Platz, R. and Andreu, J.",
       "Improved Equivalent Circuit and Analytical Model for Amorphous Silicon Solar Cells and "
       "Modules",
       "IEEE Transactions on Electron Devices", "1998", "45", "2", "423--429", "10.1109/16.658676",
       "recombination"},
      {"desoto2006", "article", "De Soto, W. and Klein, S. A. and Beckman, W. A.",
       "Improvement and validation of a model for photovoltaic array performance", "Solar Energy",
       "2006", "80", "1", "78--88", "10.1016/j.solener.2005.06.010",
       "law=desoto law=cec procedure=desoto"},
      {"dobos2012", "article", "Dobos, A. P.",
       "An Improved Coefficient Calculator for the California Energy Commission 6 Parameter "
       "Photovoltaic Module Model",
       "Journal of Solar Energy Engineering", "2012", "134", "2", "021011", "10.1115/1.4005759",
       "law=cec"},
      {"sauer2015", "article", "Sauer, K. J. and Roessler, T. and Hansen, C. W.",
       "Modeling the Irradiance and Temperature Dependence of Photovoltaic Modules in PVsyst",
       "IEEE Journal of Photovoltaics", "2015", "5", "1", "152--158",
       "10.1109/JPHOTOV.2014.2364133", "law=pvsyst procedure=pvsyst"},
      {"mermoud2010", "inproceedings", "Mermoud, A. and Lejeune, T.",
       "Performance assessment of a simulation model for PV modules of any available technology",
       "25th European Photovoltaic Solar Energy Conference, Valencia", "2010", "", "", "", "", ""},
      // Effects beside the diodes.
      {"bishop1988", "article", "Bishop, J. W.",
       "Computer simulation of the effects of electrical mismatches in photovoltaic cell "
       "interconnection circuits",
       "Solar Cells", "1988", "25", "", "73--89", "10.1016/0379-6787(88)90059-2", ""},
      {"quaschning1996", "article", "Quaschning, V. and Hanitsch, R.",
       "Numerical simulation of current-voltage characteristics of photovoltaic systems with "
       "shaded solar cells",
       "Solar Energy", "1996", "56", "6", "513--520", "10.1016/0038-092X(96)00006-0", ""},
      {"bucciarelli1979", "article", "Bucciarelli, L. L.",
       "Power loss in photovoltaic arrays due to mismatch in cell characteristics", "Solar Energy",
       "1979", "23", "4", "277--288", "10.1016/0038-092X(79)90121-X", ""},
      {"dongaonkar2010", "article",
       "Dongaonkar, S. and Servaites, J. D. and Ford, G. M. and Loser, S. and Moore, J. and "
       "Gelfand, R. M. and Mohseni, H. and Hillhouse, H. W. and Agrawal, R. and Ratner, M. A. and "
       "Marks, T. J. and Lundstrom, M. S. and Alam, M. A.",
       "Universality of non-Ohmic shunt leakage in thin-film solar cells",
       "Journal of Applied Physics", "2010", "108", "12", "124509", "10.1063/1.3518509", ""},
      {"luo2017", "article",
       "Luo, W. and Khoo, Y. S. and Hacke, P. and Naumann, V. and Lausch, D. and Harvey, S. P. and "
       "Singh, J. P. and Chai, J. and Wang, Y. and Aberle, A. G. and Ramakrishna, S.",
       "Potential-induced degradation in photovoltaic modules: a critical review",
       "Energy and Environmental Science", "2017", "10", "1", "43--68", "10.1039/C6EE02271E", ""},
      {"molto2023", "article",
       "Molto, C. and Oh, J. and Mahmood, F. I. and Li, M. and Hacke, P. and Li, F. and Smith, R. "
       "and Colvin, D. and Matam, M. and DiRubio, C. and Tamizhmani, G. and Seigneur, H.",
       "Review of potential-induced degradation in bifacial photovoltaic modules",
       "Energy Technology", "2023", "11", "", "2200943", "10.1002/ente.202200943",
       "id=polarisation"},
      {"unger2014", "article", "Unger and others", "", "", "2014", "", "", "", "10.1039/C4EE02465F",
       ""},
      {"calado2016", "article", "Calado, P. and Telford, A. M. and Bryant, D. and others",
       "Evidence for ion migration in hybrid perovskite solar cells with minimal hysteresis",
       "Nature Communications", "2016", "7", "", "13831", "10.1038/ncomms13831", ""},
      {"demtsu2006", "article", "Demtsu and Sites", "", "Thin Solid Films", "2006", "510", "",
       "320", "", ""},
      {"romero2012", "article", "Romero and others", "", "Organic Electronics", "2012", "13", "",
       "", "", ""},
      {"friesen1997", "article", "Friesen and Ossenbrink", "",
       "Solar Energy Materials and Solar Cells", "1997", "48", "", "77", "", ""},
      {"araujo1986", "article", "Araujo and Cuevas and Ruiz", "",
       "IEEE Transactions on Electron Devices", "1986", "33", "", "391", "", ""},
      {"fong2013", "article", "Fong and McIntosh and Blakers", "", "Progress in Photovoltaics",
       "2013", "21", "", "490", "", ""},
      {"grubbs1969", "article", "Grubbs, Frank E.",
       "Procedures for Detecting Outlying Observations in Samples", "Technometrics", "1969", "11",
       "1", "1--21", "10.1080/00401706.1969.10490657", ""},
      {"king2004", "techreport", "King, D. L. and Boyson, W. E. and Kratochvil, J. A.",
       "Photovoltaic Array Performance Model", "Sandia National Laboratories", "2004", "",
       "SAND2004-3535", "", "10.2172/919131", "cell_correction_K"},
      // Tests and evidence.
      {"kass1995", "article", "Kass, R. E. and Raftery, A. E.", "Bayes factors",
       "Journal of the American Statistical Association", "1995", "90", "430", "773--795",
       "10.1080/01621459.1995.10476572", "probability_none"},
      {"friedman1937", "article", "Friedman, M.",
       "The use of ranks to avoid the assumption of normality implicit in the analysis of variance",
       "Journal of the American Statistical Association", "1937", "32", "200", "675--701",
       "10.1080/01621459.1937.10503522", "friedman"},
      {"dunn1964", "article", "Dunn, O. J.", "Multiple comparisons using rank sums",
       "Technometrics", "1964", "6", "3", "241--252", "10.1080/00401706.1964.10490181", "dunn"},
      {"wilcoxon1945", "article", "Wilcoxon, F.", "Individual comparisons by ranking methods",
       "Biometrics Bulletin", "1945", "1", "6", "80--83", "10.2307/3001968", "wilcoxon"},
      {"holm1979", "article", "Holm, S.", "A Simple Sequentially Rejective Multiple Test Procedure",
       "Scandinavian Journal of Statistics", "1979", "6", "2", "65--70", "", "p_holm"},
      // Cells in the laboratory.
      {"green1981", "article", "Green, M. A.",
       "Solar cell fill factors: General graph and empirical expressions",
       "Solid-State Electronics", "1981", "24", "", "788--789", "10.1016/0038-1101(81)90062-9",
       "green_n1"},
      {"pysch2007", "article", "Pysch, D. and Mette, A. and Glunz, S. W.",
       "A review and comparison of different methods to determine the series resistance of solar "
       "cells",
       "Solar Energy Materials and Solar Cells", "2007", "91", "18", "1698--1706",
       "10.1016/j.solmat.2007.05.026", "method=lit*"},
      {"wolf1963", "article", "Wolf and Rauschenbach", "", "", "1963", "", "", "",
       "10.1016/0365-1789(63)90063-8", "method=two*"},
      {"hysteresis_index", "article", "", "", "", "", "", "", "", "10.1021/acsenergylett.8b01627",
       "index_power"},
      // Standards and constants.
      {"iec60891", "misc", kIec,
       "Photovoltaic devices -- Procedures for temperature and irradiance corrections to measured "
       "I-V characteristics",
       "IEC 60891:2021", "2021", "", "", "", "",
       "procedure=iec1 procedure=iec2 procedure=iec3 procedure=iec4"},
      {"hishikawa", "article", "Hishikawa and others", "", "", "", "", "", "",
       "10.1109/JPHOTOV.2017.2762586", "procedure=iec4"},
      {"iec60904_1", "misc", kIec,
       "Photovoltaic devices -- Part 1: Measurement of photovoltaic current-voltage "
       "characteristics",
       "IEC 60904-1:2020", "2020", "", "", "", "", ""},
      {"iec60904_5", "misc", kIec,
       "Photovoltaic devices -- Part 5: Determination of the equivalent cell temperature (ECT) of "
       "photovoltaic (PV) devices by the open-circuit voltage method",
       "IEC 60904-5:2011", "2011", "", "", "", "", ""},
      {"iec60904_10", "misc", kIec, "", "IEC 60904-10:2020", "2020", "", "", "", "", ""},
      {"iec61853_1", "misc", kIec,
       "Photovoltaic (PV) module performance testing and energy rating -- Part 1: Irradiance and "
       "temperature performance measurements and power rating",
       "IEC 61853-1:2011", "2011", "", "", "", "", "matrix"},
      {"iec62446_3", "misc", kIec, "", "IEC TS 62446-3:2017", "2017", "", "", "", "", ""},
      {"jcgm100", "misc", kJcgm,
       "Evaluation of measurement data -- Guide to the expression of uncertainty in measurement",
       "JCGM 100:2008", "2008", "", "", "", "", "coverage_factor"},
      {"jcgm101", "misc", kJcgm,
       "Evaluation of measurement data -- Supplement 1 to the ``Guide to the expression of "
       "uncertainty in measurement'' -- Propagation of distributions using a Monte Carlo method",
       "JCGM 101:2008", "2008", "", "", "", "", "draws"},
      {"tiesinga2021", "article",
       "Tiesinga, E. and Mohr, P. J. and Newell, D. B. and Taylor, B. N.",
       "CODATA recommended values of the fundamental physical constants: 2018",
       "Reviews of Modern Physics", "2021", "93", "2", "025010", "10.1103/RevModPhys.93.025010",
       "constants=codata constants_shown=codata"},
      // Published curves.
      {"easwarakhanthan1986", "article",
       "Easwarakhanthan, T. and Bottin, J. and Bouhouch, I. and Boutrit, C.",
       "Nonlinear minimization algorithm for determining the solar cell parameters with "
       "microcomputers",
       "International Journal of Solar Energy", "1986", "4", "", "1--12",
       "10.1080/01425918608909835", "name=rtc_france curve=rtc_france name=pwp201 curve=pwp201"},
  };
  return references;
}

const Publication* FindPublication(const std::string& key) {
  for (const Publication& reference : Publications()) {
    if (key == reference.key) return &reference;
  }
  return nullptr;
}

}  // namespace lyrefit
