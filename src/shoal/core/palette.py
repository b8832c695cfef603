"""Colors that mean the same in every picture and on every map.

Okabe and Ito, "Color Universal Design", 2008: distinct for readers with any color vision.
"""

TARGET = "#D55E00"  # vermilion, for targets and time on them alone; its neighbor orange comes late among the fleets
FLEET_COLORS = ("#0072B2", "#56B4E9", "#009E73", "#CC79A7", "#F0E442", "#E69F00", "#000000")
