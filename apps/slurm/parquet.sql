-- Parquet of results.csv, in the folder of the results: duckdb < parquet.sql. The types are those of
-- results.schema.json; empty fields are NULL.
SET VARIABLE types = (
  SELECT list(CASE field.type WHEN 'number' THEN 'DOUBLE'
                              WHEN 'integer' THEN 'BIGINT'
                              WHEN 'boolean' THEN 'BOOLEAN'
                              ELSE 'VARCHAR' END)
  FROM (SELECT unnest(fields) AS field FROM read_json('results.schema.json')));
COPY (FROM read_csv('results.csv', header = true, types = getvariable('types')))
  TO 'results.parquet' (FORMAT parquet, COMPRESSION zstd);
