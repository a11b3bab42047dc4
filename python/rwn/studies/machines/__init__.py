"""Real machines: recordings of others that rwn is tried on, and nominal models to begin from; no data are kept here."""
